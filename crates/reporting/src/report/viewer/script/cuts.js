// Range profile and Doppler cut at the cursor.

/** Lowest and highest level of all cuts, dB over the noise. */
function levelAxis(map) {
  const highest = map.levels_db.reduce((a, b) => Math.max(a, b), -Infinity);
  return { from: -15, to: Math.max(20, 10 * Math.ceil((highest + 1) / 10)) };
}

function drawRangeProfile(canvas, state) {
  const { map } = state.frame;
  const sheet = sheetOf(canvas, mapAxes(map).x, levelAxis(map), leftOfMap(map));
  clearSheet(sheet, state.colours);
  const place = (column) => map.range_m[0] + column * map.range_m[1];
  const strongest = Array.from({ length: map.columns }, (_, column) => strongestOfColumn(map, column));
  trace(
    sheet,
    strongest.map((level, i) => [place(i), level]),
    state.colours.soft,
    1,
  );
  const { row } = cellOf(map, state.cursor);
  const levels = map.levels_db.slice(row * map.columns, (row + 1) * map.columns);
  trace(
    sheet,
    [...levels].map((level, i) => [place(i), level]),
    cssColour(state.colours.named.c0),
    1.6,
  );
  upright(sheet, state.cursor.range, state.colours);
  drawAxes(sheet, state.colours, "range, m", "dB over noise");
}

function drawDopplerCut(canvas, state) {
  const { map } = state.frame;
  const sheet = sheetOf(canvas, levelAxis(map), mapAxes(map).y, leftOfMap(map));
  clearSheet(sheet, state.colours);
  const { row, column } = cellOf(map, state.cursor);
  const cut = Array.from({ length: map.rows }, (_, i) => [
    map.levels_db[i * map.columns + column],
    map.velocity_mps[0] + i * map.velocity_mps[1],
  ]);
  trace(sheet, cut, cssColour(state.colours.named.c0), 1.6);
  level(sheet, map.velocity_mps[0] + row * map.velocity_mps[1], state.colours);
  drawAxes(sheet, state.colours, "dB over noise", "radial velocity, m/s");
}

function strongestOfColumn(map, column) {
  let strongest = -Infinity;
  for (let row = 0; row < map.rows; row++)
    strongest = Math.max(strongest, map.levels_db[row * map.columns + column]);
  return strongest;
}

/** A line through points of a sheet, as far as they lie on it. */
function trace({ context, box, across, up }, points, colour, width) {
  context.save();
  context.beginPath();
  context.rect(box.left, box.top, box.right - box.left, box.bottom - box.top);
  context.clip();
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.beginPath();
  points.forEach(([x, y], i) =>
    i ? context.lineTo(across(x), up(y)) : context.moveTo(across(x), up(y)),
  );
  context.stroke();
  context.restore();
}

function upright({ context, box, across }, x, colours) {
  dashed(context, colours, [across(x), box.top], [across(x), box.bottom]);
}

function level({ context, box, up }, y, colours) {
  dashed(context, colours, [box.left, up(y)], [box.right, up(y)]);
}

function dashed(context, colours, from, to) {
  context.strokeStyle = colours.ink;
  context.lineWidth = 1;
  context.setLineDash([5, 4]);
  context.beginPath();
  context.moveTo(...from);
  context.lineTo(...to);
  context.stroke();
  context.setLineDash([]);
}
