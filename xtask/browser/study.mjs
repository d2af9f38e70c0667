// The view of a study's designs.

import { pause } from "./chromium.mjs";
import { COLOURS, RECT, TEXT, openView, set } from "./looks.mjs";
import { holds } from "./tally.mjs";

export async function studyIsViewed(page, url) {
  await openView(page, url);
  holds("starts the view of a study", await page.value("typeof waysideViewer === 'object'"));
  const [none, bodies, dots] = [
    await page.value(COLOURS([])),
    await page.value(COLOURS(["bodies"])),
    await page.value(COLOURS(["designs"])),
  ];
  holds("draws vehicles and designs", bodies > none + 20 && dots > none, [none, bodies, dots]);
  await page.value("look.layers()");
  await designsAreChosen(page);
  await situationsChange(page);
}

/** A click on the dot of a design, in the picture and in the chart. */
async function designsAreChosen(page) {
  const count = await page.value("waysideViewer.view.page.designs.length");
  for (const [canvas, pixelOf] of [
    ["space", "pixelOf"],
    ["chart", "pixelOnChart"],
  ]) {
    const box = await page.value(RECT(canvas));
    const before = await page.value("waysideViewer.view.state.chosen");
    const other = count - 1 - before;
    const [x, y] = await page.value(`waysideViewer.${pixelOf}(${other})`);
    await page.click(box.x + x, box.y + y);
    await pause(100);
    const chosen = await page.value("waysideViewer.view.state.chosen");
    const text = await page.value(TEXT("panel"));
    const isTold = text.includes(`Design ${chosen}`) && text.includes("coverage");
    const claim = `tells of the design whose dot in the ${canvas} is clicked`;
    holds(claim, chosen === other && isTold, [other, chosen]);
  }
}

async function situationsChange(page) {
  const place = "waysideViewer.view.page.situations[waysideViewer.view.state.situation].bodies[1].place_m[0]";
  const first = await page.value(place);
  await page.value(set("situation", "value", 1));
  const [second, words] = [await page.value(place), await page.value(TEXT("situation-told"))];
  const isOther = first !== second && words.includes("lane 3");
  holds("goes from situation to situation", isOther, [first, second, words]);
  const mean = await page.value(TEXT("scale-told"));
  await page.value(set("alone", "checked", true));
  const alone = await page.value(TEXT("scale-told"));
  holds("colours one situation alone", mean.includes("mean over") && alone.includes("alone"), [mean, alone]);
}
