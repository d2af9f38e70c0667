// Paths of a frame, strongest first: lines over the places where they are reflected, and dots there.

/** Paths with their legs from the radar and back; those of the weaker ones would hide everything. */
const WITH_LEGS = 3000;

/** Marks of the lines and of the dots of all paths, and after each path how many there are. */
function wayMarks(paths, radar) {
  const [lines, dots] = [makeMarks(), makeMarks()];
  let corner = 0;
  paths.corners.forEach((corners, i) => {
    const look = wayLook(paths, i);
    const places = [];
    for (const end = corner + corners; corner < end; corner++) {
      places.push([0, 1, 2].map((axis) => paths.places_m[3 * corner + axis]));
    }
    for (const place of places) addMark(dots.numbers, place, { ...look, size: 2.5 });
    const isWhole = i < WITH_LEGS;
    const back = isWhole && corners > 1 ? [radar.position_m] : [];
    addLines(lines.numbers, isWhole ? [radar.position_m, ...places, ...back] : places, look);
    for (const { numbers, ends } of [lines, dots]) ends.push(numbers.length / FLOATS_OF_A_MARK);
  });
  return { lines, dots };
}

function makeMarks() {
  return { numbers: [], ends: [0] };
}

function wayLook(paths, i) {
  const below = paths.levels_dbw[0] - paths.levels_dbw[i];
  return {
    colour: Math.min(5, paths.orders[i]),
    body: paths.targets[i],
    range: paths.ranges_m[i],
    velocity: paths.velocities_mps[i],
    opacity: Math.max(0.12, 0.85 - below / 45),
  };
}

/** How many of the paths are within so many dB of the strongest. */
function countDownTo(paths, belowDb) {
  const least = paths.levels_dbw[0] + belowDb;
  const first = paths.levels_dbw.findIndex((level) => level < least);
  return first < 0 ? paths.levels_dbw.length : first;
}

/** Share of all power that is not in the first paths, each by itself. */
function shareBehind(paths, count) {
  let sum = paths.left_out_power_w;
  for (let i = count; i < paths.levels_dbw.length; i++) sum += 10 ** (paths.levels_dbw[i] / 10);
  return paths.all_power_w > 0 ? Math.min(1, sum / paths.all_power_w) : 0;
}

/** What the level slider shows and what it leaves out. */
function toldOfPaths(paths, count) {
  const shown = `${count.toLocaleString("en")} of ${counted(paths.all, "path", "paths")}`;
  return `${shown}; ${percent(shareBehind(paths, count))} of the power left out`;
}

/** Bounce orders among the first paths, with their number and level over that of all, dB. */
function ordersOf(paths, count, isOf = () => true) {
  const orders = new Map();
  for (let i = 0; i < count; i++) {
    if (!isOf(i)) continue;
    const known = orders.get(paths.orders[i]) ?? { paths: 0, power_w: 0 };
    known.paths++;
    known.power_w += 10 ** (paths.levels_dbw[i] / 10);
    orders.set(paths.orders[i], known);
  }
  return [...orders].sort((a, b) => a[0] - b[0]);
}
