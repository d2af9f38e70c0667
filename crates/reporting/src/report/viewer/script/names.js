// Names over the picture.

/** Names over the picture are buttons: they can be reached by keys, and chosen. */
function makeNames(view) {
  if (!view.space) return;
  const place = part("names");
  place.replaceChildren();
  const { radar, lanes } = view.page.surroundings;
  const name = (tag, words, at, height) => ({
    element: put(place, tag, words),
    at: [at[0], at[1], height],
  });
  const top = (body) =>
    body.place_m[2] + (body.mesh === null ? 0 : view.page.surroundings.meshes[body.mesh].box_m[1][2]);
  view.names = view.state.frame.bodies.map((body, index) => {
    const made = name("button", body.id, body.place_m, top(body) + 0.4);
    made.element.type = "button";
    made.element.addEventListener("click", () => choose(view, index));
    return made;
  });
  view.names.push(name("span", "radar", radar.position_m, radar.position_m[2] + 0.6));
  for (const lane of lanes) view.names.push(name("span", lane.name, lane.at_m, 0));
}

/** Heights of a name by which it may move to lie on no other. */
const SHIFTS = [0, -1, -2, 1, -3, 2];

/** Half a side of the square about an object's ring, pixels. */
const RING = 11;

/**
 * Puts names where they belong, or a little above; one for which there is no room is left out. Names that
 * cannot be clicked, as those of lanes, leave objects free.
 */
function placeNames({ names, space, state }) {
  const taken = [];
  const rings = ringsOf(space, state);
  for (const { element, at } of names) {
    const pixel = state.layers.names ? onScreen(space, at) : null;
    const boxes = pixel ? SHIFTS.map((shift) => boxOfName(element, pixel, shift)) : [];
    const kept = element.localName === "button" ? taken : [...taken, ...rings];
    const box = boxes.find((candidate) => isFree(candidate, kept, space.canvas));
    element.hidden = !box;
    if (!box) continue;
    taken.push(box);
    element.style.transform = `translate(${box[0]}px, ${box[1]}px)`;
  }
}

/** Squares of the pixels of objects, as far as they are shown. */
function ringsOf(space, { layers, frame }) {
  const objects = layers.objects ? frame.objects : [];
  const pixels = objects.map(({ place_m }) => onScreen(space, place_m)).filter(Boolean);
  return pixels.map(([x, y]) => [x - RING, y - RING, x + RING, y + RING]);
}

/** Left, top, right and bottom of a name that stands on a pixel, so many of its heights further down. */
function boxOfName({ offsetWidth: width, offsetHeight: height }, [x, y], shift) {
  const bottom = y + shift * height;
  return [x - width / 2, bottom - height, x + width / 2, bottom];
}

function isFree(box, taken, { clientWidth, clientHeight }) {
  const isOver = (other) =>
    box[0] < other[2] && other[0] < box[2] && box[1] < other[3] && other[1] < box[3];
  const isOut = box[0] < 0 || box[1] < 0 || box[2] > clientWidth || box[3] > clientHeight;
  return !isOut && !taken.some(isOver);
}
