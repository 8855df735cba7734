// Puts the live page in the place of its picture.

for (const link of document.querySelectorAll("a.live")) {
  const frame = document.createElement("iframe");
  frame.className = "live";
  frame.title = `Live page: ${link.querySelector("img").alt}`;
  frame.loading = "lazy";
  frame.src = link.href;
  link.replaceWith(frame);
}
