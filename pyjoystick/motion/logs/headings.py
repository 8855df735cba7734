"""Interpretation of headings: quantities in several languages, and spellings of units."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Mapping, Sequence
from typing import Final

from pyjoystick.motion.columns import Column, Heading
from pyjoystick.motion.units import UNITS, plain_unit

#: Additional spellings to `UNITS`, by kind of quantity and unit; those in lower case also match upper case.
_SPELLINGS: Final[Mapping[str, Mapping[str, str]]] = {
    "time": {
        "s": "s sec secs second seconds sek sekunde sekunden seconde secondes seg segundo segundos secondo "
        "secondi sekund sekunder",
        "ms": "ms msec msecs millisecond milliseconds millisekunde millisekunden milliseconde millisecondes "
        "milisegundos millisecondi",
        "min": "min minute minutes minuten minuto minutos minuti",
        "h": "h hour hours stunde stunden heure heures hora horas ora ore",
        "us": "us usec microsecond microseconds mikrosekunde mikrosekunden microsecondes microsegundos",
    },
    "angle": {
        "deg": "deg degs degree degrees degré degrés grados gradi graden grader º",
        "rad": "rad radian radians radiant radianten radianes radianti",
        "mrad": "mrad milliradian milliradians",
        "mdeg": "mdeg millidegree millidegrees m°",
        "gon": "gon gons gradian gradians",
    },
    "angular velocity": {
        "deg/s": "deg/s deg/sec degrees/s degree/s",
        "rad/s": "rad/s rad/sec radians/s",
        "rpm": "rpm r/min 1/min U/min rev/min",
    },
    "torque": {
        "N.m": "Nm N-m newtonmeter newton-meter newton.meter newtonmetre",
        "N.mm": "Nmm N-mm",
        "N.cm": "Ncm N-cm",
        "mN.m": "mNm",
        "kN.m": "kNm",
        "lbf.in": "lbf-in lbfin in-lb in-lbf in.lb in.lbf lb-in lb.in inlb lbin inch-pound inch-pounds",
        "lbf.ft": "lbf-ft lbfft ft-lb ft-lbf ft.lb ft.lbf lb-ft lb.ft ftlb lbft foot-pound foot-pounds",
    },
    "length": {"mm": "millimeter millimeters millimetre", "um": "mikrometer micrometer micron microns"},
    "force": {"N": "newton newtons", "kgf": "kp kilopond", "lbf": "pound-force"},
    "voltage": {"V": "volt volts v", "mV": "millivolt millivolts"},
    "count": {
        "count": "count counts cts digit digits inc increment increments inkrement inkremente tick ticks "
        "lsb step steps pulse pulses impulse adc raw"
    },
}
#: Unit by kind and spelling.
_KNOWN: Final = {
    kind: {unit: unit for unit in UNITS.get(kind, {})}
    | {word: unit for unit, words in spellings.items() for word in words.split()}
    for kind, spellings in _SPELLINGS.items()
} | {"angular acceleration": {unit: unit for unit in UNITS["angular acceleration"]}}
#: Kinds of quantity by their names in `Column`, and whole headings that mean them.
_NAMES: Final[Mapping[str, tuple[str, str]]] = {
    "time": (
        "time",
        "t,time,zeit,uhrzeit,zeitstempel,messzeit,temps,tempo,tiempo,tijd,tid,czas,cas,aika,ido,время,час,时间,時間,"
        "timestamp,time stamp,elapsed time,relative time,simulation time,x time",
    ),
    "theta": (
        "angle",
        "theta,θ,phi,φ,angle,winkel,drehwinkel,angulo,angolo,hoek,vinkel,kat,uhel,uhol,kulma,szog,угол,кут,角度,"
        "angular position,position angulaire,joystick angle,joystick winkel,winkel joystick,angle joystick,"
        "winkelposition",
    ),
    "omega": ("angular velocity", "omega,ω,angular velocity,angular rate,winkelgeschwindigkeit"),
    "alpha": ("angular acceleration", "angular acceleration,winkelbeschleunigung"),
    "T": ("torque", "torque,hand torque,moment,drehmoment,couple,momento,coppia,koppel,moment de force"),
    "F": ("force", "force,hand force,kraft,handkraft,fuerza,forza,kracht,kraftsensor"),
    # Of testing machines.
    "travel": (
        "length",
        "travel,weg,standardweg,traversenweg,verschiebung,extension,displacement,crosshead,stroke,deplacement,"
        "course,desplazamiento,spostamento,corsa",
    ),
    "force": (
        "force",
        "force,kraft,standardkraft,prufkraft,load,standard force,charge,fuerza,forza,carga,carico,kracht",
    ),
}
_OF_MACHINES: Final = ("travel", "force")
#: Letters that mean a quantity in this case only, and only with a unit of its kind.
_SYMBOLS: Final = {"T": "M", "F": "F"}
_BRACKETS: Final = re.compile(r"(?P<name>.*?)\s*[(\[{<](?P<unit>[^()\[\]{}<>]*)[)\]}>]\s*")
_AFTER: Final = re.compile(
    r"(?P<name>[^/]+?)\s*/\s*(?P<unit>.+)|(?P<name2>.+?)(?:,\s*|\s+in\s+|[_ ])(?P<unit2>\S+)"
)
_STRUCTURE: Final = re.compile(r"[^\W\d]\w*(?:\(\d+\))?")
#: What may stand before a point for a function of a quantity.
_CHANGES: Final = frozenset(
    (
        "abs",
        "arg",
        "cos",
        "d",
        "delta",
        "dev",
        "diff",
        "err",
        "error",
        "inv",
        "inverse",
        "max",
        "mean",
        "min",
        "minus",
        "neg",
        "negative",
        "norm",
        "ref",
        "rel",
        "rms",
        "sd",
        "sigma",
        "sin",
        "std",
        "tan",
        "var",
    )
)
_MINUS: Final = ("-", "\N{MINUS SIGN}", "\N{EN DASH}")
_GERMAN: Final = ("zeit", "winkel", "kraft", "moment", "weg", "geschwindigkeit")


def spelled(kind: str, unit: str) -> str | None:
    """A unit in the spelling of `UNITS`, None if it is not of this kind."""
    known, plain = _KNOWN.get(kind, {}), plain_unit(unit).rstrip(".")
    return known.get(plain) or known.get(unit) or known.get(plain.casefold())


def is_unit(text: str) -> bool:
    """Whether a text is a known unit of any kind."""
    return text.casefold() == "grad" or any(spelled(kind, text) for kind in _KNOWN)


def understood(text: str, others: Iterable[str] = ()) -> Heading:
    """Parse name and unit of a heading: ``Winkel [Grad]``, ``t/s``, ``Time in ms``, ``angle_deg``.

    Args:
        text: the heading
        others: all headings of the table; *Grad* means degrees only next to German words, and otherwise gon
    """
    name, unit = text, ""
    if match := _BRACKETS.fullmatch(text):
        name, unit = match["name"], match["unit"]
    elif match := _AFTER.fullmatch(text):
        name, unit = match["name"] or match["name2"], match["unit"] or match["unit2"]
        short = (len(unit) == 1 or unit.casefold() == "min") and match["name2"]
        short = short and meaning(name) != "time" and unit != "°"  # "angle min" is the least angle
        if not is_unit(unit) or short:
            name, unit = text, ""
    is_grad = "grad" in unit.casefold()
    if is_grad and any(word in other.casefold() for other in others for word in _GERMAN):
        unit = re.sub(r"\b[Gg]rad\b", "deg", unit)
    unit = unit.strip()
    return Heading(text, name.strip(), next(filter(None, (spelled(kind, unit) for kind in _KNOWN)), unit))


def meaning(name: str) -> str | None:
    """The quantity with this name in one of the languages; none for its negative, as ``-theta``."""
    if unicodedata.normalize("NFKC", name).strip(" _.")[:1] in _MINUS:
        return None
    plain = _plain(name)
    for quantity in _NAMES:
        if plain in _names_of(quantity) and not (quantity == "time" and name == "T"):
            return quantity
    return next((quantity for quantity, symbols in _SYMBOLS.items() if name in (quantity, symbols)), None)


def time_heading(text: str, *, by_unit: bool = False) -> Heading | None:
    """Name and unit of a heading that means the time, as ``time_ms``; None for another.

    Args:
        text: the heading
        by_unit: whether a unit of time is enough, as in ``Period (s)``
    """
    heading = understood(text)
    is_time = meaning(last_part(heading.name)) == "time"
    return heading if is_time or (by_unit and spelled("time", heading.unit) is not None) else None


def _plain(name: str) -> str:
    """A name in lower case without accents."""
    plain = "".join(c for c in unicodedata.normalize("NFKD", name.casefold()) if not unicodedata.combining(c))
    return " ".join(re.split(r"[\s_.\-]+", plain)).strip()


def _names_of(quantity: str) -> list[str]:
    return _NAMES[quantity][1].split(",")


def kind_of(column: Column) -> str:
    """Kind of quantity of a column with one of the names above; empty for other columns."""
    kind = _NAMES.get(column.name, ("",))[0]
    return kind if kind and set(column.units) & set(UNITS[kind]) else ""


def candidates(column: Column, headings: Sequence[Heading]) -> list[Heading]:
    """Headings that may belong to a column: by its own name, or else by another."""
    kind = kind_of(column)
    own = [h for h in headings if column.name in (h.text, h.name)]
    folded = column.name.casefold()
    if len(folded) > 1:  # t is not T
        own = own or [h for h in headings if folded in (h.text.casefold(), h.name.casefold())]
    return own or [h for h in headings if kind and _may_mean(last_part(h.name), column.name)]


def _may_mean(name: str, quantity: str) -> bool:
    """Whether a word may mean the column: *Kraft* is F in some tables, and the machine's force in others."""
    return meaning(name) == quantity or (quantity in _OF_MACHINES and _plain(name) in _names_of(quantity))


def last_part(name: str) -> str:
    """Name of a field without its enclosing structures; ``neg. angle`` and ``abs.theta`` have none."""
    around, _, last = name.rpartition(".")
    is_field = all(map(_STRUCTURE.fullmatch, around.split("."))) and around.casefold() not in _CHANGES
    return last if last and is_field else name


def reading_unit(unit: str) -> str:
    """``V``, ``mV`` or ``count`` if the unit is that of an instrument's raw readings."""
    return spelled("voltage", unit) or spelled("count", unit) or ""


def scale_factor(name: str, unit: str) -> float | None:
    """Factor to SI units for a unit of a quantity (theta, omega, T, F); None if it has no such unit."""
    kind = _NAMES[name][0] if name in _NAMES else ""
    found = spelled(kind, unit.strip())
    return UNITS[kind][found] if found else None
