// Designs by what they are worth and what they cost, and one of them in words.

/** Ends of an axis over the values of a metric, with some room. */
function axisOver(page, metric) {
  const values = page.designs.flatMap(({ means }) => means[metric]?.[0] ?? []);
  const [low, high] = values.length ? [Math.min(...values), Math.max(...values)] : [0, 1];
  const room = 0.06 * (high - low) || 0.5;
  return { from: low - room, to: high + room };
}

function chartSheet({ page, metric, across }) {
  return sheetOf(part("chart"), axisOver(page, across), axisOver(page, metric));
}

/** Pixel of a design on the chart; `null` where one of its two metrics is not known. */
function placeOnChart(sheet, { page, metric, across }, design) {
  const { means } = page.designs[design];
  if (!means[metric] || !means[across]) return null;
  return [sheet.across(means[across][0]), sheet.up(means[metric][0])];
}

function pixelOnChart(state, design) {
  return placeOnChart(chartSheet(state), state, design);
}

/** The design nearest to a pixel of the chart; `null` where none is near. */
function designOnChart(state, pixel) {
  const sheet = chartSheet(state);
  const pixels = state.page.designs.map((_, design) => placeOnChart(sheet, state, design));
  return nearestTo(pixel, pixels, FINGER);
}

function drawChart(state) {
  const { page, colours } = state;
  const sheet = chartSheet(state);
  clearSheet(sheet, colours);
  const ends = endsOfWorth(state);
  page.designs.forEach((_, design) => {
    const at = placeOnChart(sheet, state, design);
    if (at) discOnChart(sheet.context, at, shareOf(state, ends, design), colours);
  });
  ringOnChart(sheet, state, page.answer, cssColour(colours.named.c1), 10);
  ringOnChart(sheet, state, state.chosen, cssColour(colours.named.found), 8);
  drawAxes(sheet, colours, page.metrics[state.across].name, page.metrics[state.metric].name);
}

function discOnChart(context, [x, y], share, colours) {
  context.beginPath();
  context.arc(x, y, 5, 0, 7);
  context.fillStyle = share === null ? colours.paper : cssColour(toneOf(share).map((v) => v / 255));
  context.fill();
  context.strokeStyle = colours.soft;
  context.lineWidth = 1;
  context.stroke();
}

function ringOnChart(sheet, state, design, colour, radius) {
  const at = design === null ? null : placeOnChart(sheet, state, design);
  if (!at) return;
  sheet.context.strokeStyle = colour;
  sheet.context.lineWidth = 2;
  sheet.context.beginPath();
  sheet.context.arc(...at, radius, 0, 7);
  sheet.context.stroke();
}

/** All that is told of a design: what it is, where it stands, and what it was worth beside the answer. */
function tellOfDesign(panel, page, index) {
  panel.replaceChildren();
  const design = page.designs[index];
  put(panel, "h3", `Design ${design.number}`);
  put(panel, "p", verdictOn(page, index));
  put(panel, "p", page.radars[design.radar].stands);
  rowsInto(panel, "It has", [], page.axes.map((axis, i) => [axis, design.labels[i]]));
  const answer = page.answer === null || page.answer === index ? null : page.designs[page.answer];
  const head = ["mean", "this design", ...(answer ? ["the answer"] : [])];
  const shown = answer ? [design, answer] : [design];
  const row = ({ name }, i) => [name, ...shown.map(({ means }) => interval(means[i]))];
  const caption = `Over ${counted(design.situations, "situation", "situations")}`;
  rowsInto(panel, caption, head, page.metrics.map(row));
}

/** The study's verdict on a design. */
function verdictOn(page, index) {
  const design = page.designs[index];
  const words = [
    [index === page.answer, "the answer of the study"],
    [index === page.best, "the best mean"],
    [design.is_candidate && index !== page.best, "not told apart from the best"],
    [design.is_on_front, "on the Pareto front: no design is better at the same or lower cost"],
  ];
  const said = words.filter(([holds]) => holds).map(([, text]) => text);
  if (said.length) return `${said[0][0].toUpperCase()}${said.join("; ").slice(1)}.`;
  return "Another design is at least as good at no higher cost.";
}

/** A mean with half the width of its interval. */
function interval(mean) {
  if (!mean) return "–";
  const [value, half] = mean;
  if (half === null || half === 0) return shortly(value);
  const digits = Math.max(0, 1 - Math.floor(Math.log10(half)));
  return `${told(value, Math.min(6, digits))} ± ${told(half, Math.min(6, digits))}`;
}
