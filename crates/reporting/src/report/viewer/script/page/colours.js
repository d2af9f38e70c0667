// Colours of the page's own drawings, read from its style, so that light and dark are one thing.

/** Colours of marks by their index, as many as the program of marks takes: bounce orders 0 to 5 first. */
const MARKS = [
  "c6",
  "c0",
  "c1",
  "c2",
  "c3",
  "c4",
  "found",
  "car",
  "bus",
  "truck",
  "motorcycle",
  "lanes",
  "c5",
];
const MARK = Object.fromEntries(MARKS.map((name, index) => [name, index]));
const ORDER_NAMES = ["point target", "1 bounce", "2 bounces", "3 bounces", "4 bounces", "5 bounces"];

function readColours() {
  const probe = put(document.body, "i");
  const of = (className) => {
    probe.className = className;
    return rgba(getComputedStyle(probe).color);
  };
  const named = Object.fromEntries(
    [...MARKS, "plain", "radar", "clutter"].map((name) => [name, of(name)]),
  );
  const colours = { named, marks: MARKS.flatMap((name) => named[name]), ...pageColours() };
  probe.remove();
  return colours;
}

function pageColours() {
  const style = getComputedStyle(document.documentElement);
  const of = (name) => style.getPropertyValue(name).trim();
  return {
    paper: of("--paper"),
    ink: of("--ink"),
    soft: of("--soft"),
    rule: of("--rule"),
    road: of("--road"),
  };
}

/** Red, green, blue and opacity, 0 to 1, of `#rgb`, `#rrggbb` or `rgb(…)`. */
function rgba(text) {
  const digits = /^#([0-9a-f]+)$/i.exec(text)?.[1];
  if (!digits)
    return [
      ...text
        .match(/[\d.]+/g)
        .slice(0, 3)
        .map((value) => value / 255),
      1,
    ];
  const width = digits.length / 3;
  const channel = (i) => parseInt(digits.slice(i * width, (i + 1) * width).repeat(2 / width), 16) / 255;
  return [channel(0), channel(1), channel(2), 1];
}

const cssColour = ([r, g, b]) => `rgb(${[r, g, b].map((v) => Math.round(255 * v)).join(" ")})`;

/** Colour of levels from 0 to 1: eight samples of inferno, linear between, as in the page's maps. */
const HEAT = [
  [0, 0, 4],
  [40, 11, 84],
  [101, 21, 110],
  [159, 42, 99],
  [212, 72, 66],
  [245, 125, 21],
  [250, 193, 39],
  [252, 255, 164],
];

function heat(level) {
  const place = 7 * Math.min(1, Math.max(0, level));
  const low = Math.min(6, Math.floor(place));
  return [0, 1, 2].map((c) => HEAT[low][c] + (place - low) * (HEAT[low + 1][c] - HEAT[low][c]));
}

/** A colour on its way to another. */
function toned(from, to, share) {
  return from.map((value, i) => value + share * (to[i] - value));
}
