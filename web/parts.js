// Where the parts of the page lie: beside this module, or inside the page where it is a single file.

/// The program, which the page began to fetch, or to unpack, before any module was there.
export const program = () => globalThis.centrodeProgram ?? fetch(new URL("centrode_bg.wasm", import.meta.url));

/// A worker that runs a module.
export const worker = (name) => globalThis.centrodeWorker?.(name) ?? new Worker(new URL(name, import.meta.url), { type: "module" });

/// Whether the page is a single file, which has nothing beside it.
export const SINGLE = "centrodeWorker" in globalThis;
