// The menu of versions of a published site: leads to the same page of another version, or to its first page.

const select = document.querySelector(".versions select");

async function fill() {
  const top = new URL(select.dataset.top || "./", document.baseURI);
  const list = new URL("../versions.json", top);
  const answer = await fetch(list);
  if (!answer.ok) return;
  for (const name of await answer.json()) {
    const here = name === select.dataset.version;
    select.add(new Option(name, new URL(`${name}/`, list).href, here, here));
  }
  select.parentElement.hidden = false;
  select.addEventListener("change", async () => {
    const page = new URL(location.pathname.slice(top.pathname.length), select.value);
    const found = await fetch(page, { method: "HEAD" });
    location.assign(found.ok ? page : select.value);
  });
}

if (select) fill();
