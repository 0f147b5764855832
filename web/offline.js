// Has the page kept for when there is no network.
import { SINGLE } from "./parts.js";

/// Asks the browser to keep the page. A frame, a single file and an insecure host are not kept, and a browser that refuses does without.
export function keepOffline() {
  if (!navigator.serviceWorker || window.parent !== window || SINGLE) return;
  navigator.serviceWorker
    .register(new URL("offline-worker.js", document.baseURI), { updateViaCache: "none" })
    .catch((error) => console.info(`The page is not kept for use without a network: ${error.message}`));
}
