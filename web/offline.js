// Has the page kept for when there is no network.
import { SINGLE } from "./parts.js";

/// Asks the browser to keep the page. A frame, a single file and an insecure host are not kept, and a browser that refuses does without.
export function keepOffline() {
  if (window.parent !== window || SINGLE) return;
  const without = (error) => console.info(`The page is not kept for use without a network: ${error.message}`);
  try {
    navigator.serviceWorker?.register(new URL("offline-worker.js", document.baseURI), { updateViaCache: "none" }).catch(without);
  } catch (error) {
    // Where storage is refused, asking for it is an error in some browsers.
    without(error);
  }
}
