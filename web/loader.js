// Loads the program, starts it on the canvas, and keeps the page readable whatever goes wrong.
import { address, fragment, listen, tell } from "./address.js";
import { download } from "./download.js";
import { elements } from "./elements.js";
import { passThrough } from "./embed.js";
import { acceptDrops, choose, chooseLog, picture, pixels, save } from "./files.js";
import { logs } from "./logs.js";
import { messages } from "./messages.js";
import { mirror } from "./mirror.js";
import { keepOffline } from "./offline.js";
import { knowVersion, showFailure, showLost, showNoGpu, showNotices, showProgress, showRunning } from "./pages.js";
import { program, SINGLE } from "./parts.js";
import * as progress from "./progress.js";
import { readQuery } from "./query.js";
import { sound } from "./sound.js";
import { studies } from "./studies.js";

const { settings, notices } = readQuery(location.search);
const host = messages(settings.origins);
/// The program, once it is there.
let running = null;
let failed = false;

function fail(show, ...args) {
  // The first cause is the one worth reading; what follows are its consequences.
  if (failed) return;
  failed = true;
  show(...args);
  host?.fail(document.querySelector(`#${document.documentElement.dataset.page} h1`).textContent, args[0]);
}

addEventListener("error", (event) => {
  // Without `error` it is an element that did not load, or a browser's note such as a resize loop.
  if (event.error) fail(showFailure, describe(event.error));
});
addEventListener("unhandledrejection", (event) => fail(showFailure, describe(event.reason)));

function describe(cause) {
  return cause instanceof Error ? (cause.stack?.includes(cause.message) ? cause.stack : `${cause}\n${cause.stack ?? ""}`) : String(cause);
}

const hooks = {
  report(json) {
    if (failed) return;
    const report = JSON.parse(json);
    mirror.report(report);
    sound(report);
    if (mirror.ready) return;
    mirror.ready = true;
    // The first frame was computed just now and is on the screen after the next one.
    requestAnimationFrame(() => requestAnimationFrame(() => failed || showRunning()));
  },
  panicked: (message) => fail(showFailure, message),
  // Said from inside the program, which is let go of first.
  lost: (message) => queueMicrotask(() => lost(message)),
  address: tell,
  save,
  // A single file holds the documents, too, and shows one where it is asked for.
  open: (page) => window.open(new URL(SINGLE ? page.replace(/^(theory|licences)\.html/, "?$1") : page, location.href), "_blank", "noopener"),
  post: (json) => host?.post(JSON.parse(json)),
  // Set once the program is there.
  keep: () => {},
  choose: () => {},
  picture: () => {},
  pixels: () => {},
  study: () => {},
  replaceWorker: () => false,
  chooseLog: () => {},
  readLog: () => {},
  fetchLog: () => {},
  mirror: () => {},
};

/// A canvas is bound to one kind of context for good, so every further attempt gets a fresh one.
function freshCanvas() {
  const old = document.getElementById("canvas");
  const canvas = old.cloneNode();
  canvas.removeAttribute("style");
  old.replaceWith(canvas);
  return canvas;
}

/// The elements take the keyboard and tell what there is; the canvas takes the pointer, and the field beside it what is typed there.
function leaveToElements(canvas) {
  canvas.tabIndex = -1;
  for (const field of document.querySelectorAll("#stage > input")) {
    field.tabIndex = -1;
    field.setAttribute("aria-label", "Text typed into the picture");
  }
}

/// Gives the canvas a pixel for each of the screen's. At a change of their ratio eframe multiplies what it has, which makes too many of them
/// where they had been counted anew already. A pixel more or less is rounding.
function fit(canvas) {
  const { width, height } = canvas.getBoundingClientRect();
  const [wide, high] = [width, height].map((side) => Math.round(side * devicePixelRatio));
  if (Math.abs(canvas.width - wide) > 1) canvas.width = wide;
  if (Math.abs(canvas.height - high) > 1) canvas.height = high;
}

/// A screen with other pixels: the canvas is cleared for them, and who is paused would not paint it. The interface learns of the pixels in
/// one frame and lays out by them in the next.
function paintOnOtherScreens(core) {
  const paint = (times) => {
    fit(document.getElementById("canvas"));
    core.paint();
    if (times > 1) requestAnimationFrame(() => paint(times - 1));
  };
  const change = () => {
    paint(4);
    paintOnOtherScreens(core);
  };
  matchMedia(`(resolution: ${devicePixelRatio}dppx)`).addEventListener("change", change, { once: true });
}

/// Whether the browser has WebGPU itself.
async function hasWebGpu() {
  // What an attempt with WebGL put in its place.
  delete navigator.gpu;
  return Boolean(await navigator.gpu?.requestAdapter());
}

async function startOnSome(core) {
  const attempts = settings.renderer === "webgl" ? ["webgl", "webgpu"] : ["webgpu", "webgl"];
  // What was lost twice is not to be relied on.
  if (settings.renderer === "auto" && losses.length === MOST_LOSSES) attempts.reverse();
  const errors = [];
  for (const renderer of attempts) {
    const canvas = freshCanvas();
    // One that does not arrive is no matter of graphics.
    const webgl = renderer === "webgl" && (await import("./webgl.js"));
    const options = {
      reducedMotion: matchMedia("(prefers-reduced-motion: reduce)").matches,
      test: settings.test,
      worker: settings.worker === "auto",
      address: address(),
      fragment: fragment(),
      embed: settings.embed,
      hosted: host !== null,
      progress: progress.kept(),
    };
    try {
      if (webgl) webgl.provide(canvas);
      else if (!(await hasWebGpu())) throw new Error("the browser gives no WebGPU adapter");
      await core.start(canvas, options, hooks);
      leaveToElements(canvas);
      mirror.renderer = renderer;
      if (settings.renderer !== "auto" && settings.renderer !== renderer) {
        notices.push(`renderer=${settings.renderer} is not available in this browser; the page draws with ${renderer} instead.`);
      }
      return true;
    } catch (error) {
      errors.push(`${renderer}: ${error instanceof Error ? error.message : error}`);
    }
  }
  fail(showNoGpu, errors.join("\n"));
  return false;
}

// More losses than these within a minute are not by chance.
const MOST_LOSSES = 2;
const MINUTE_MS = 60_000;
let losses = [];
/// The start that goes on, and those that wait for it.
let starts = Promise.resolve(false);

/// What the page is drawn with is gone: it goes on as it was on a fresh canvas.
function lost(detail) {
  if (failed || !running) return;
  const now = performance.now();
  losses = [...losses.filter((before) => now - before < MINUTE_MS), now];
  // At once: nobody paints with what is gone.
  running.set_aside();
  if (losses.length > MOST_LOSSES) return fail(showLost, detail);
  console.warn(`The page lost its graphics and begins anew on a fresh canvas. ${detail}`);
  begin(running).catch((error) => fail(showFailure, describe(error)));
}

/// Starts the interface, once whatever start is under way has ended.
function begin(core) {
  starts = starts.then(() => !failed && startOnSome(core));
  return starts;
}

async function main() {
  passThrough(() => running);
  // Fetched while the program is. If it does not arrive, that is told when it is used.
  hasWebGpu().then((has) => has || import("./webgl.js")).catch(() => {});
  const script = document.querySelector("script[data-wasm-bytes]");
  const core = await import("./centrode.js");
  const wasm = await download(program(), Number(script.dataset.wasmBytes), showProgress);
  const module = await WebAssembly.compileStreaming(wasm);
  const { memory } = await core.default({ module_or_path: module });
  running = core;
  knowVersion(core.version());
  const { ask, replace } = studies(core, module);
  hooks.study = ask;
  hooks.replaceWorker = replace;
  const kept = logs(core, module);
  hooks.choose = () => choose(core, kept);
  hooks.chooseLog = () => chooseLog(core, kept);
  hooks.keep = (text) => progress.keep(text) || core.progress_not_kept();
  hooks.readLog = kept.read;
  hooks.fetchLog = kept.fetchBytes;
  hooks.picture = (...drawing) => picture(core, ...drawing);
  hooks.pixels = (...image) => pixels(core, ...image);
  acceptDrops(core, kept);
  hooks.mirror = elements(document.getElementById("elements"), core, () => document.getElementById("canvas"));
  listen((text) => core.go(text));
  if (settings.test) globalThis.centrode = { ...core, memory };
  if (!(await begin(core))) return;
  paintOnOtherScreens(core);
  host?.start(core);
  keepOffline();
  showNotices(notices, () => document.getElementById("canvas").focus());
}

main().catch((error) => fail(showFailure, describe(error)));
