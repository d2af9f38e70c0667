// Fewer paths while the eye moves, as many as the machine draws in time; all of them when it rests.

const REST_MS = 250;
const SLOW_MS = 90;
const QUICK_MS = 35;
const FEWEST = 500;

function makeMotion() {
  return { isOn: false, paths: 8000, last: 0, rest: 0 };
}

/** The time between two pictures tells how many paths the next one may have. */
function beginMotion(moving) {
  const now = performance.now();
  const took = now - moving.last;
  if (moving.isOn && took > SLOW_MS) moving.paths = Math.max(FEWEST, moving.paths / 2);
  if (moving.isOn && took < QUICK_MS) moving.paths *= 1.1;
  Object.assign(moving, { isOn: true, last: now });
}

function endMotion(moving) {
  moving.isOn = false;
}

/** How many of so many paths are drawn now. */
function drawnNow(moving, shown) {
  return moving.isOn ? Math.min(shown, Math.round(moving.paths)) : shown;
}
