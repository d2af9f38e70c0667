// The range-Doppler map: levels over the noise, the detector's mask, objects, and the cursor.

/** Room about a sheet; on the left at least, where numbers and name of an axis stand. */
const MARGIN = { left: 52, right: 10, top: 8, bottom: 40 };
const AXIS_FONT = "12px system-ui, sans-serif";
/** Foot of the name beside an axis, distance of the numbers from it, and of the axis from the numbers. */
const NAME = { foot: 13, apart: 4 };
const BESIDE_AXIS = 5;
/** Levels of the darkest cell and of the brightest at least, dB over the noise. */
const DARKEST_DB = -4;
const BRIGHTEST_DB = 30;
const DETECTED = 2;

function brightestOf({ levels_db }) {
  return Math.max(
    BRIGHTEST_DB,
    levels_db.reduce((a, b) => Math.max(a, b), -Infinity),
  );
}

/** Words of the scale of colours. */
function toldOfScale(map) {
  return `${told(DARKEST_DB, 0)} to ${told(brightestOf(map), 0)} dB over noise`;
}

/** The middle of the strongest cell. */
function strongestCell(map) {
  const cell = map.levels_db.indexOf(map.levels_db.reduce((a, b) => Math.max(a, b), -Infinity));
  const value = ([first, step], i) => first + i * step;
  return {
    range: value(map.range_m, cell % map.columns),
    velocity: value(map.velocity_mps, Math.floor(cell / map.columns)),
  };
}

/** Levels of a frame's map as a picture, one pixel a cell, receding above. */
function mapPicture(map) {
  const { rows, columns, levels_db } = map;
  const picture = new OffscreenCanvas(columns, rows);
  const context = picture.getContext("2d");
  const image = context.createImageData(columns, rows);
  const brightest = brightestOf(map);
  for (let row = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) {
      const level = (levels_db[row * columns + column] - DARKEST_DB) / (brightest - DARKEST_DB);
      image.data.set([...heat(level), 255], 4 * ((rows - 1 - row) * columns + column));
    }
  }
  context.putImageData(image, 0, 0);
  return picture;
}

/** Room left of a sheet of a canvas for the numbers of its vertical axis and the name beside them. */
function leftOf(canvas, y) {
  const context = canvas.getContext("2d");
  context.font = AXIS_FONT;
  const rows = numbered(rowsOf(y, canvas.clientHeight - MARGIN.top - MARGIN.bottom));
  const widths = rows.map(([, words]) => context.measureText(words).width);
  return Math.max(MARGIN.left, NAME.foot + NAME.apart + Math.max(...widths) + BESIDE_AXIS);
}

/** The same of the map, whose profile and cut have their axes where it has its own. */
const leftOfMap = (map) => leftOf(part("map"), mapAxes(map).y);

/** A canvas made ready: its context in pixels of the page, its sheet and its axes. */
function sheetOf(canvas, x, y, left = leftOf(canvas, y)) {
  const pixels = resize(canvas);
  const context = canvas.getContext("2d");
  context.setTransform(pixels, 0, 0, pixels, 0, 0);
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  const box = {
    left,
    right: width - MARGIN.right,
    top: MARGIN.top,
    bottom: height - MARGIN.bottom,
  };
  const across = (value) => box.left + ((value - x.from) / (x.to - x.from)) * (box.right - box.left);
  const up = (value) => box.bottom - ((value - y.from) / (y.to - y.from)) * (box.bottom - box.top);
  return { context, width, height, box, across, up, x, y };
}

/** Ends of an axis of cells: half a cell beyond the first and the last. */
function endsOf([first, step], count) {
  return { from: first - step / 2, to: first + (count - 0.5) * step };
}

function mapAxes(map) {
  return { x: endsOf(map.range_m, map.columns), y: endsOf(map.velocity_mps, map.rows) };
}

function drawMap(canvas, state) {
  const { map } = state.frame;
  const { x, y } = mapAxes(map);
  const sheet = sheetOf(canvas, x, y, leftOfMap(map));
  const { context, box } = sheet;
  clearSheet(sheet, state.colours);
  context.imageSmoothingEnabled = false;
  context.drawImage(state.picture, box.left, box.top, box.right - box.left, box.bottom - box.top);
  context.save();
  context.beginPath();
  context.rect(box.left, box.top, box.right - box.left, box.bottom - box.top);
  context.clip();
  drawMask(sheet, map);
  drawObjects(sheet, state.frame.objects);
  context.restore();
  drawAxes(sheet, state.colours, "range, m", "radial velocity, m/s");
  crosshair(sheet, state.cursor);
}

function clearSheet({ context, width, height }, colours) {
  context.fillStyle = colours.paper;
  context.fillRect(0, 0, width, height);
}

/** Outline of the cells that the detector took. */
function drawMask({ context, across, up }, map) {
  const {
    rows,
    columns,
    mask,
    range_m: [r0, dr],
    velocity_mps: [v0, dv],
  } = map;
  const taken = (row, column) =>
    row >= 0 &&
    row < rows &&
    column >= 0 &&
    column < columns &&
    mask[row * columns + column] === DETECTED;
  context.strokeStyle = "#39d0ff";
  context.lineWidth = 1;
  context.beginPath();
  const side = (row, column, [a, b], [c, d]) => {
    context.moveTo(across(r0 + (column + a) * dr), up(v0 + (row + b) * dv));
    context.lineTo(across(r0 + (column + c) * dr), up(v0 + (row + d) * dv));
  };
  for (let row = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++) {
      if (!taken(row, column)) continue;
      if (!taken(row, column - 1)) side(row, column, [-0.5, -0.5], [-0.5, 0.5]);
      if (!taken(row, column + 1)) side(row, column, [0.5, -0.5], [0.5, 0.5]);
      if (!taken(row - 1, column)) side(row, column, [-0.5, -0.5], [0.5, -0.5]);
      if (!taken(row + 1, column)) side(row, column, [-0.5, 0.5], [0.5, 0.5]);
    }
  }
  context.stroke();
}

/** The velocity at which an axis shows another one, which may lie beyond its ends. */
function shownAt({ from, to }, velocity) {
  const span = to - from;
  return velocity - span * Math.floor((velocity - from) / span);
}

/** Objects as rings, at the velocities at which the map shows them. */
function drawObjects({ context, across, up, y }, objects) {
  context.lineWidth = 1.6;
  for (const { range_m, velocity_mps } of objects) {
    const shown = shownAt(y, velocity_mps);
    for (const [colour, shift] of [
      ["#000", 1],
      ["#fff", 0],
    ]) {
      context.strokeStyle = colour;
      context.beginPath();
      context.arc(across(range_m) + shift, up(shown) + shift, 9, 0, 7);
      context.stroke();
    }
  }
}

function crosshair({ context, box, across, up, y }, { range, velocity }) {
  const shown = shownAt(y, velocity);
  context.lineWidth = 1;
  for (const [colour, dash] of [
    ["#000", []],
    ["#fff", [5, 4]],
  ]) {
    context.strokeStyle = colour;
    context.setLineDash(dash);
    context.beginPath();
    context.moveTo(across(range), box.top);
    context.lineTo(across(range), box.bottom);
    context.moveTo(box.left, up(shown));
    context.lineTo(box.right, up(shown));
    context.stroke();
  }
  context.setLineDash([]);
}

/** Round values within an axis, about so many. */
function ticks({ from, to }, about) {
  const [low, high] = [Math.min(from, to), Math.max(from, to)];
  const raw = (high - low) / about;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= raw);
  const first = Math.ceil(low / step);
  return Array.from(
    { length: Math.max(0, Math.floor(high / step) - first + 1) },
    (_, i) => (first + i) * step,
  );
}

/** Digits behind the point that tell values of such a step apart. */
function digitsOf(step) {
  return Math.min(6, Math.max(0, Math.ceil(-Math.log10(step) - 1e-9)));
}

/** Round values of a vertical axis of so many pixels. */
const rowsOf = (y, height) => ticks(y, height / 40);

/** Values, each with its words. */
function numbered(values) {
  const digits = values.length > 1 ? digitsOf(values[1] - values[0]) : 0;
  return values.map((value) => [value, told(value, digits)]);
}

function drawAxes(sheet, colours, xName, yName) {
  const { context, box, across, up, x, y } = sheet;
  context.strokeStyle = colours.soft;
  context.fillStyle = colours.ink;
  context.font = AXIS_FONT;
  context.lineWidth = 1;
  context.strokeRect(box.left, box.top, box.right - box.left, box.bottom - box.top);
  context.textAlign = "center";
  for (const [value, words] of numbered(ticks(x, (box.right - box.left) / 65)))
    context.fillText(words, across(value), box.bottom + 15);
  context.fillText(xName, (box.left + box.right) / 2, box.bottom + 33);
  context.textAlign = "right";
  for (const [value, words] of numbered(rowsOf(y, box.bottom - box.top)))
    context.fillText(words, box.left - BESIDE_AXIS, up(value) + 4);
  context.save();
  context.translate(NAME.foot, (box.top + box.bottom) / 2);
  context.rotate(-Math.PI / 2);
  context.textAlign = "center";
  context.fillText(yName, 0, 0);
  context.restore();
}

/** Range and velocity of the cell under a pixel; `null` outside of the map. */
function cellUnder(canvas, map, [px, py]) {
  const { x, y } = mapAxes(map);
  const { box } = sheetOf(canvas, x, y, leftOfMap(map));
  const share = [(px - box.left) / (box.right - box.left), (box.bottom - py) / (box.bottom - box.top)];
  if (share.some((value) => value < 0 || value > 1)) return null;
  const range = x.from + share[0] * (x.to - x.from);
  const velocity = y.from + share[1] * (y.to - y.from);
  return snapped(map, { range, velocity });
}

/** Pixel of a range and a velocity. */
function pixelOnMap(canvas, map, { range, velocity }) {
  const { x, y } = mapAxes(map);
  const { across, up } = sheetOf(canvas, x, y, leftOfMap(map));
  return [across(range), up(velocity)];
}

/** Row and column of a range and a velocity; velocities are folded. */
function cellOf(map, { range, velocity }) {
  const index = (value, [first, step], count) =>
    Math.min(count - 1, Math.max(0, Math.round((value - first) / step)));
  return {
    row: index(shownAt(mapAxes(map).y, velocity), map.velocity_mps, map.rows),
    column: index(range, map.range_m, map.columns),
  };
}

/** The middle of the cell that a range and a velocity lie in. */
function snapped(map, at) {
  const { row, column } = cellOf(map, at);
  const value = ([first, step], i) => first + i * step;
  return { range: value(map.range_m, column), velocity: value(map.velocity_mps, row) };
}
