// Numbers of the page: arrays of whole steps as base64 (packed.rs writes them), and how they are told.

/** A part of the view by its name. */
const part = (name) => document.getElementById(`viewer-${name}`);

/** The page's numbers, with every packed array unpacked. */
function readPage() {
  const text = document.getElementById("viewer-data").textContent;
  return JSON.parse(text, (_, value) => (isPacked(value) ? unpacked(value) : value));
}

function isPacked(value) {
  return value !== null && typeof value === "object" && typeof value.base64 === "string";
}

/** Values of a packed array: whole numbers as they are, steps as Float32, places in the world as Float64. */
function unpacked({ kind, step, from, base64 }) {
  const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
  const types = { Int16: Int16Array, Uint8: Uint8Array, Uint16: Uint16Array, Uint32: Uint32Array };
  const whole = new types[kind](bytes.buffer);
  if (from) return Float64Array.from(whole, (steps, i) => from[i % 3] + steps * step);
  return kind === "Int16" ? Float32Array.from(whole, (steps) => steps * step) : whole;
}

/** A number with so many digits and a true minus; a dash where there is none. */
function told(value, digits, unit = "") {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  return value.toFixed(digits).replace("-", "−") + (unit && ` ${unit}`);
}

/** The sign stays on the line of its number. */
const PERCENT = "\u00a0%";

/** A share in percent, to two digits, or to what is told at all. */
function percent(share) {
  if (share <= 0) return "none";
  if (share < 5e-5) return `less than 0.01${PERCENT}`;
  return (share < 0.995 ? (100 * share).toPrecision(2) : (100 * share).toFixed(1)) + PERCENT;
}

/** A number that tells the place of a thing in a row: 2nd, 3rd, 11th, 21st. */
function ordinal(number) {
  const isTeen = Math.floor(number / 10) % 10 === 1;
  return `${number}${(!isTeen && ["th", "st", "nd", "rd"][number % 10]) || "th"}`;
}

/** Number of a thing with its word in one or many. */
function counted(count, one, many) {
  return `${count.toLocaleString("en")} ${count === 1 ? one : many}`;
}

/** A new element with a text and a class, put into another. */
function put(parent, tag, text = "", className = "") {
  const element = document.createElement(tag);
  element.textContent = text;
  if (className) element.className = className;
  parent.append(element);
  return element;
}
