// Pages on paper, on a telephone, and where no script runs.

import { pause } from "./chromium.mjs";
import { openView } from "./looks.mjs";
import { holds } from "./tally.mjs";

export async function telephone(page, name, url) {
  await openView(page, url, [400, 800]);
  await pause(200);
  const width = await page.value("document.documentElement.scrollWidth");
  holds(`fits ${name} on a telephone of 400 pixels`, width <= 400, width);
}

const SHOWN = `(() => {
  const tall = (selector, least) =>
    [...document.querySelectorAll(selector)].some((part) => part.getBoundingClientRect().height > least);
  return {
    isGone: getComputedStyle(document.getElementById("viewer")).display === "none",
    drawing: tall("figure svg", 100),
    table: tall("table", 30),
    words: tall("noscript p", 10),
  };
})()`;

/** A page's drawings and tables stand for its view on paper, and where no script runs. */
export async function withoutView(page, name, url) {
  await openView(page, url);
  await page.theme("light", "print");
  const printed = await page.value(SHOWN);
  const isWhole = ({ isGone, drawing, table }) => isGone && drawing && table;
  holds(`prints ${name} with drawings and tables alone`, isWhole(printed) && !printed.words, printed);
  await page.theme("light");
  await page.send("Emulation.setScriptExecutionDisabled", { value: true });
  await page.open("about:blank");
  await page.open(url);
  const still = await page.value(SHOWN);
  holds(`shows ${name} where no script runs, and says so`, isWhole(still) && still.words, still);
  await page.send("Emulation.setScriptExecutionDisabled", { value: false });
  await page.open("about:blank");
}
