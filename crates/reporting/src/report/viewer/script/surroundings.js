// Road, lanes, field of view and bodies, as every view of a scene shows them.

/** Road, lanes and meshes on the card. */
function makeSurroundings(graphics, { roads_m: roads, lines_m: lines, meshes }) {
  const lanes = [];
  for (const line of lines) {
    const places = line.map(([x, y]) => [x, y, LINE_HEIGHT_M]);
    addLines(lanes, places, { colour: MARK.lanes });
  }
  return {
    road: surfaceOf(graphics, roadSurface(roads)),
    lanes: markBuffer(graphics, lanes),
    meshes: meshes.map((mesh) => surfaceOf(graphics, meshSurface(mesh))),
  };
}

function surfaceOf(graphics, { corners, triangles }) {
  return surfaceBuffer(graphics, corners, triangles);
}

function meshSurface({ corners_m, triangles, box_m }) {
  return corners_m
    ? { corners: corners_m, triangles }
    : { corners: boxCorners(box_m).flat(), triangles: FACES };
}

function drawRoad({ graphics, road, lanes, state }, look) {
  drawSurface(graphics, road, { ...look, colour: rgba(state.colours.road) });
  drawMarks(graphics, lanes, { ...look, form: FORM.line });
}

/** A radar's field of view on the ground, its boresight and its pole. */
function drawBeam({ graphics, state }, look, { beam, radarLines }) {
  drawSurface(graphics, beam, { ...look, colour: [...state.colours.named.c0.slice(0, 3), 0.07] });
  drawMarks(graphics, radarLines, { ...look, form: FORM.line });
}

/** Bodies where they stand; those that are faint by their index go towards the paper. */
function drawBodies({ graphics, meshes, state }, { clip }, bodies, isFaint) {
  const paper = rgba(state.colours.paper);
  bodies.forEach((body, index) => {
    if (body.mesh === null) return;
    const colour = toned(bodyColour(state.colours, body), paper, isFaint(index) ? 0.6 : 0.15);
    const place = worldFromBody(body.place_m, body.yaw_rad);
    drawSurface(graphics, meshes[body.mesh], { clip, body: place, colour, shaded: 1 });
  });
}

function bodyColour({ named }, body) {
  return named[body.is_clutter ? "clutter" : (body.class ?? "plain")];
}
