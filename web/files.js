// Files: saved, chosen, dropped.

// No scenario is larger; the program says so.
const MAX_BYTES = 2 ** 20;

/// Saves bytes as a file of a kind.
export function save(name, kind, bytes) {
  // Copied here: what the program hands over is its memory.
  download(name, new Blob([bytes], { type: kind }));
}

function download(name, blob) {
  const url = URL.createObjectURL(blob);
  const link = Object.assign(document.createElement("a"), { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  // Some browsers read it only after the click is over.
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}

/// Saves an SVG as PNG, `scale` pixels to a point. A picture does not see the fonts of the page, so that its own two go with it.
export function picture(core, name, svg, scale, regular, strong) {
  const fonts = [
    ["Inter", 400, regular],
    ["Inter Semi Bold", 600, strong],
  ].map(([family, weight, bytes]) => ({ family, weight, blob: new Blob([bytes], { type: "font/otf" }) }));
  saveDrawn(core, name, drawn(svg, scale, fonts));
}

/// Saves pixels as PNG: rows from the top, red, green, blue and alpha of each.
export function pixels(core, name, width, height, rgba) {
  const image = new ImageData(new Uint8ClampedArray(rgba), width, height);
  const [canvas, context] = sheet(width, height);
  context?.putImageData(image, 0, 0);
  saveDrawn(core, name, context ? encoded(canvas) : Promise.reject(NO_CANVAS));
}

function saveDrawn(core, name, blob) {
  blob.then(
    (blob) => download(name, blob),
    (error) => core.save_failed(name, `The browser could not draw it: ${error?.message ?? error}`),
  );
}

const NO_CANVAS = new Error("it has no canvas for so many pixels");

function sheet(width, height) {
  const canvas = Object.assign(document.createElement("canvas"), { width, height });
  return [canvas, canvas.getContext("2d")];
}

async function encoded(canvas) {
  const blob = await new Promise((done) => canvas.toBlob(done, "image/png"));
  if (!blob) throw new Error("it gave no pixels");
  return blob;
}

async function drawn(svg, scale, fonts) {
  const face = async ({ family, weight, blob }) =>
    `@font-face{font-family:"${family}";font-weight:${weight};src:url(${await dataUrl(blob)}) format("opentype")}`;
  const style = `<style>${(await Promise.all(fonts.map(face))).join("")}</style>`;
  const image = new Image();
  image.src = await dataUrl(new Blob([svg.replace(">", () => `>${style}`)], { type: "image/svg+xml" }));
  await image.decode();
  const [width, height] = [image.naturalWidth, image.naturalHeight].map((points) => Math.round(points * scale));
  const [canvas, context] = sheet(width, height);
  if (!context) throw NO_CANVAS;
  context.drawImage(image, 0, 0, width, height);
  // Safari reads a picture's fonts once it is drawn: only the second time it has them.
  await new Promise((next) => requestAnimationFrame(next));
  context.drawImage(image, 0, 0, width, height);
  return encoded(canvas);
}

function dataUrl(blob) {
  return new Promise((done, fail) => {
    const reader = new FileReader();
    reader.onload = () => done(reader.result);
    reader.onerror = () => fail(reader.error);
    reader.readAsDataURL(blob);
  });
}

/// Hands a file to the program; `logs` takes those that are logs.
async function open(core, logs, file) {
  try {
    if (await logs.take(file)) return;
    // One byte more than is allowed says that it is too large.
    const bytes = await file.slice(0, MAX_BYTES + 1).arrayBuffer();
    core.file_opened(file.name, new Uint8Array(bytes));
  } catch (error) {
    core.file_failed(file.name, `It could not be read: ${error?.message ?? error}`);
  }
}

/// Lets the person choose a scenario.
export function choose(core, logs) {
  pick(".toml", (file) => open(core, logs, file));
}

/// Lets the person choose a log. Some systems do not know the extensions of logs, so all files can be chosen.
export function chooseLog(core, logs) {
  pick("", (file) => open(core, logs, file), () => core.log_not_chosen());
}

function pick(accept, take, left = () => {}) {
  const input = Object.assign(document.createElement("input"), { type: "file", accept });
  // Some browsers forget an input that is nowhere.
  input.hidden = true;
  const done = () => input.remove();
  input.addEventListener("change", () => {
    if (input.files[0]) take(input.files[0]);
    done();
  });
  input.addEventListener("cancel", () => {
    done();
    left();
  });
  document.body.append(input);
  input.click();
}

/// Takes a file that is dropped anywhere on the page, which the browser would otherwise go to.
export function acceptDrops(core, logs) {
  const files = (event) => event.dataTransfer?.types.includes("Files");
  // Before the canvas, which keeps such events to itself.
  addEventListener("dragover", (event) => files(event) && event.preventDefault(), true);
  addEventListener(
    "drop",
    (event) => {
      if (!files(event)) return;
      event.preventDefault();
      const file = event.dataTransfer.files[0];
      if (file) open(core, logs, file);
    },
    true,
  );
}
