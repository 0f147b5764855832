// Keeps the page for when there is no network, and never shows an old build while there is one: pages are asked of the host first; parts
// lie under a name that is their content's, so that a kept one is the right one. `cargo xtask build` fills in what the build consists of.

const BUILD = "@BUILD@";
const FILES = ["./", ...@FILES@];
const NAME = "centrode ";
const SCOPE = new URL("./", location.href).pathname;

addEventListener("install", (event) => event.waitUntil(keep()));
addEventListener("activate", (event) => event.waitUntil(tidy()));
addEventListener("fetch", (event) => {
  const { request } = event;
  const url = new URL(request.url);
  if (request.method !== "GET" || url.origin !== location.origin || !url.pathname.startsWith(SCOPE)) return;
  const name = url.pathname.slice(SCOPE.length);
  event.respondWith(/^build-[0-9a-f]{16}\//.test(name) ? kept(request) : fresh(request, name));
});

async function keep() {
  const cache = await caches.open(NAME + BUILD);
  try {
    // What the build's name stands for never changes; the rest is asked of the host, whatever a cache on the way says.
    await cache.addAll(FILES.map((file) => new Request(file, { cache: file.startsWith(BUILD) ? "default" : "reload" })));
    const index = await (await cache.match("./")).text();
    if (!index.includes(BUILD)) throw new Error("the host has another build by now");
  } catch (error) {
    await caches.delete(NAME + BUILD);
    throw error;
  }
  await skipWaiting();
}

/// Drops old builds but the last: a tab that shows it may yet ask for a part.
async function tidy() {
  const others = (await caches.keys()).filter((name) => name.startsWith(NAME) && name !== NAME + BUILD);
  await Promise.all(others.slice(0, -1).map((name) => caches.delete(name)));
  await clients.claim();
}

async function kept(request) {
  return (await caches.match(request, { ignoreSearch: true })) ?? fetch(request);
}

async function fresh(request, name) {
  try {
    return await fetch(request);
  } catch (error) {
    const cache = await caches.open(NAME + BUILD);
    const found = await cache.match(name === "" || name === "index.html" ? "./" : name, { ignoreSearch: true });
    if (found) return found;
    throw error;
  }
}
