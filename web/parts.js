// Where the parts of the page lie: beside this module, or inside the page where it is a single file.

/// The address of a part.
export const part = (name) => globalThis.centrodeParts?.[name] ?? new URL(name, import.meta.url);

/// The program, which the page began to fetch, or to unpack, before any module was there.
export const program = () => globalThis.centrodeProgram ?? fetch(part("centrode_bg.wasm"));

/// Whether the page is a single file, which has nothing beside it.
export const SINGLE = "centrodeParts" in globalThis;
