// A Chromium without a screen, spoken to over a pipe (Chrome DevTools Protocol); nothing but Node is needed.

import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const FLAGS = [
  "--headless",
  "--no-sandbox",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
  "--disable-extensions",
  "--remote-debugging-pipe",
  "--use-gl=angle",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  "--hide-scrollbars",
];

/** Starts the browser and opens an empty page. */
export async function launch(program) {
  const profile = mkdtempSync(join(tmpdir(), "wayside-browser-"));
  const flags = [...FLAGS, `--user-data-dir=${profile}`, "about:blank"];
  const child = spawn(program, flags, { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
  const ended = new Promise((resolve) => child.on("exit", resolve));
  const send = protocol(child);
  const { targetInfos } = await send("Target.getTargets");
  const { targetId } = targetInfos.find(({ type }) => type === "page");
  const { sessionId } = await send("Target.attachToTarget", { targetId, flatten: true });
  const page = new Page((method, params) => send(method, params, sessionId));
  await page.send("Page.enable");
  await page.send("Runtime.enable");
  const close = async () => {
    await send("Browser.close").catch(() => {});
    await ended;
    rmSync(profile, { recursive: true, force: true, maxRetries: 5, retryDelay: 200 });
  };
  return { page, close };
}

/** A function that sends a command and gives its answer. */
function protocol(child) {
  const [input, output] = [child.stdio[3], child.stdio[4]];
  const waiting = new Map();
  let [last, heard] = [0, ""];
  output.setEncoding("utf8");
  output.on("data", (text) => {
    const messages = (heard + text).split("\0");
    heard = messages.pop();
    for (const message of messages.map((text) => JSON.parse(text))) answer(waiting, message);
  });
  child.on("exit", () => waiting.forEach(({ reject }) => reject(new Error("the browser ended"))));
  return (method, params = {}, sessionId = undefined) =>
    new Promise((resolve, reject) => {
      const id = ++last;
      waiting.set(id, { resolve, reject });
      input.write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
    });
}

function answer(waiting, { id, result, error }) {
  const waits = waiting.get(id);
  if (!waits) return;
  waiting.delete(id);
  if (error) waits.reject(new Error(error.message));
  else waits.resolve(result);
}

/** A page of the browser. */
class Page {
  constructor(send) {
    this.send = send;
  }

  async size(width, height) {
    const metrics = { width, height, deviceScaleFactor: 1, mobile: width < 600 };
    await this.send("Emulation.setDeviceMetricsOverride", metrics);
  }

  async theme(scheme, media = "") {
    const features = [{ name: "prefers-color-scheme", value: scheme }];
    await this.send("Emulation.setEmulatedMedia", { media, features });
  }

  async open(url) {
    await this.send("Page.navigate", { url });
    for (let i = 0; i < 600; i++) {
      if ((await this.value("document.readyState + location.href")) === `complete${url}`) return;
      await pause(50);
    }
    throw new Error(`${url} was not opened within 30 s`);
  }

  /** Value of an expression in the page. */
  async value(expression) {
    const asked = { expression, returnByValue: true, awaitPromise: true };
    const { result, exceptionDetails } = await this.send("Runtime.evaluate", asked);
    if (exceptionDetails)
      throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }

  async mouse(type, x, y, buttons = 0) {
    const button = buttons ? "left" : "none";
    await this.send("Input.dispatchMouseEvent", {
      type,
      x,
      y,
      button,
      buttons,
      clickCount: buttons ? 1 : 0,
    });
  }

  async click(x, y) {
    await this.mouse("mouseMoved", x, y);
    await this.mouse("mousePressed", x, y, 1);
    await this.send("Input.dispatchMouseEvent", {
      type: "mouseReleased",
      x,
      y,
      button: "left",
      buttons: 0,
      clickCount: 1,
    });
  }

  /** PNG of the window, or of a part of the page. */
  async picture(clip = undefined) {
    const asked = { format: "png", captureBeyondViewport: Boolean(clip), clip };
    return Buffer.from((await this.send("Page.captureScreenshot", asked)).data, "base64");
  }
}

export const pause = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));
