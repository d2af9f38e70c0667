// Panel of the chosen vehicle: class, position, paths and error budget.

const CLASSES = ["car", "bus", "truck", "motorcycle"];

function fillPanel(panel, state, letGo) {
  panel.replaceChildren();
  const body = state.chosen === null ? null : state.frame.bodies[state.chosen];
  if (!body) {
    put(
      panel,
      "p",
      "Click a vehicle or its name to see its class, paths and error budget here.",
    );
    return;
  }
  const head = put(panel, "h3", body.id);
  const button = put(head, "button", "let go");
  button.type = "button";
  button.addEventListener("click", letGo);
  const target = state.frame.targets.find(({ id }) => id === body.id);
  if (target) {
    tellOfClass(panel, target);
    tellOfOwnError(panel, target, body);
    tellOfPlace(panel, target, heightOf(state));
  }
  if (state.frame.paths) tellOfPaths(panel, state);
  tellOfErrors(panel, state);
}

/** A small table with a caption; rows of words and values, `null` rows are left out. */
function rowsInto(panel, caption, head, rows) {
  const table = put(panel, "table");
  put(table, "caption", caption);
  if (head.length) {
    const line = put(put(table, "thead"), "tr");
    head.forEach((words) => put(line, "th", words));
  }
  const lines = put(table, "tbody");
  for (const row of rows.filter(Boolean)) {
    const line = put(lines, "tr");
    row.forEach((words, i) => put(line, i ? "td" : "th", words));
  }
  return table;
}

function tellOfClass(panel, target) {
  const { probabilities, track_probabilities: byTrack } = target;
  const rows = CLASSES.map((name) => [
    `probability of ${name}`,
    told(probabilities[name], 3),
    told(byTrack?.[name], 3),
  ]);
  const table = rowsInto(
    panel,
    "Class",
    ["", "frame", "track"],
    [
      ["true", target.class ?? "–", ""],
      ["predicted", target.predicted_class ?? "–", target.track_class ?? "–"],
      ...rows,
    ],
  );
  CLASSES.forEach((name, i) => {
    const cell = table.tBodies[0].rows[i + 2].cells[1];
    cell.style.setProperty("--share", `${100 * (probabilities[name] ?? 0)}%`);
    cell.classList.add("viewer-share");
  });
}

/** The chosen body's measured height in words; `null` where no object is it. */
function heightOf({ frame, chosen }) {
  const object = frame.objects.find(({ target }) => target === chosen);
  if (!object) return null;
  return told(object.place_m[2], 2) + (object.height === MEASURED ? "" : " (not measured)");
}

function tellOfPlace(panel, { truth, estimate, found }, height) {
  const range = truth.echo_range_m ?? truth.range_m;
  const velocity = truth.echo_radial_velocity_mps ?? truth.radial_velocity_mps;
  const words = found === null ? "not detectable" : found ? "found" : "missed";
  rowsInto(
    panel,
    `Position (${words})`,
    ["", "true", "measured"],
    [
      ["range, m", told(range, 2), told(estimate?.range_m, 2)],
      ["velocity, m/s", told(velocity, 2), told(estimate?.radial_velocity_mps, 2)],
      ["x, m", told(truth.x_m, 2), told(estimate?.x_m, 2)],
      ["y, m", told(truth.y_m, 2), told(estimate?.y_m, 2)],
      ["z, m", told(truth.z_m, 2), height ?? "–"],
      ["lane", truth.lane ?? "–", estimate?.lane ?? "–"],
      estimate && ["SNR, dB", "", told(estimate.snr_db, 1)],
    ],
  );
  put(panel, "p", "True x, y and z are those of the body's origin; range and velocity are the echo's.");
}

function tellOfPaths(panel, state) {
  const { paths } = state.frame;
  const isOf = (i) => paths.targets[i] === state.chosen;
  const rows = ordersOf(paths, state.shown, isOf).map(([order, { paths: count, power_w }]) => [
    ORDER_NAMES[order],
    count.toLocaleString("en"),
    told(10 * Math.log10(power_w), 1),
  ]);
  rowsInto(panel, "Shown paths that hit it first", ["", "number", "power, dBW"], rows);
  const share = paths.power_of_bodies_w[state.chosen] / paths.all_power_w;
  put(
    panel,
    "p",
    `All its paths carry ${told(100 * share, 1)} % of the frame's power. Path powers are added here ` +
      "without their phases.",
  );
}

/** The measured numerical error of the vehicle's own echo, and what it does to the estimates. */
function tellOfOwnError(panel, { error }, { mesh }) {
  if (!error) {
    const why = mesh === null ? "a point target's echo is exact" : "it was not measured";
    put(panel, "p", `No numerical error of its own echo: ${why}.`);
    return;
  }
  rowsInto(
    panel,
    "This vehicle's own error",
    [],
    [
      ["echo, dB", told(error.echo_db, 1)],
      ["σ of range, m", told(error.range_m, 3)],
      ["σ of velocity, m/s", told(error.radial_velocity_mps, 4)],
      ["σ across, m", told(error.across_m, 3)],
    ],
  );
  put(
    panel,
    "p",
    "Numerical error relative to this vehicle's own echo, and the standard errors that it causes in the " +
      "estimates.",
  );
}

/** Error budgets are of a frame's whole echo; of one body's they are larger by its share. */
function tellOfErrors(panel, state) {
  const { error_db, model_error_db, paths } = state.frame;
  const power = paths?.power_of_bodies_w[state.chosen];
  const larger = power > 0 ? 10 * Math.log10(paths.all_power_w / power) : null;
  const of = (db) => told(db === null || larger === null ? null : db + larger, 1);
  const row = (words, db) => db !== null && [words, told(db, 1), of(db)];
  const named = (errors, prefix) =>
    Object.entries(errors)
      .filter(([name]) => name !== "total")
      .map(([name, db]) => row(prefix + name.replace("_", " "), db));
  rowsInto(
    panel,
    "Error budget, dB",
    ["source", "frame", "vehicle, at most"],
    [row("total", error_db.total), ...named(error_db, ""), ...named(model_error_db, "model: ")],
  );
  put(panel, "p", "The last column assumes that all of the frame's error falls on this vehicle.");
}
