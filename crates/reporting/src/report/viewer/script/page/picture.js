// A picture in three dimensions: how it is begun, and where a place lies in it.

/** Clears the picture and gives what all of it is drawn with. */
function beginPicture({ canvas, graphics: { gl }, state }) {
  const pixels = resize(canvas);
  gl.viewport(0, 0, canvas.width, canvas.height);
  gl.clearColor(...rgba(state.colours.paper).slice(0, 3), 1);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  const clip = clipFromWorld(state.camera, canvas.width / canvas.height);
  return { clip, pixels, colours: state.colours.marks };
}

/** The index of the place nearest to a pixel; `null` where none is within so many pixels. */
function nearestTo([x, y], places, within) {
  let [best, nearest] = [null, within];
  places.forEach((place, index) => {
    const distance = place ? Math.hypot(place[0] - x, place[1] - y) : Infinity;
    if (distance < nearest) [best, nearest] = [index, distance];
  });
  return best;
}

/** Pixels of the page of a world place; `null` behind the eye. */
function onScreen({ canvas, state }, place) {
  const clip = clipFromWorld(state.camera, canvas.width / canvas.height);
  const along = (row) =>
    clip[row] * place[0] + clip[4 + row] * place[1] + clip[8 + row] * place[2] + clip[12 + row];
  const depth = along(3);
  if (depth <= 0) return null;
  return [
    (canvas.clientWidth * (along(0) / depth + 1)) / 2,
    (canvas.clientHeight * (1 - along(1) / depth)) / 2,
  ];
}
