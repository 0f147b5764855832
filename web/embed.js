// In the frame of another page: wheel, fingers and keys are that page's until the person clicks in, and again once they click outside.

/// Begins to leave to the page around this one what is not meant for this one. Does nothing in a page of its own.
export function passThrough() {
  if (window.parent === window) return;
  const { classList } = document.documentElement;
  classList.add("framed");
  const taken = () => classList.contains("taken");
  const take = () => classList.add("taken");
  const leave = () => classList.remove("taken");

  // A finger that comes down may be about to scroll. Lifted in its place it was a tap, which the interface hears of then.
  let held = null;
  const press = (event) => {
    if (taken()) return;
    if (event.pointerType === "mouse") return take();
    held = event;
    event.stopImmediatePropagation();
  };
  const release = () => {
    if (taken()) return;
    take();
    const down = held;
    held = null;
    if (down) down.target.dispatchEvent(new PointerEvent("pointerdown", down));
  };
  addEventListener("pointerdown", press, true);
  addEventListener("pointerup", release, true);
  addEventListener("pointercancel", () => (held = null), true);
  // By the Tab key.
  addEventListener("focusin", take, true);
  addEventListener("blur", (event) => event.target === window && leave(), true);
  // The interface keeps Tab to itself: without this there would be no way out for who has no pointer.
  const out = () => {
    document.activeElement?.blur();
    leave();
    window.parent.focus();
  };
  // Once the interface has heard it, too.
  addEventListener("keydown", (event) => event.key === "Escape" && setTimeout(out), true);

  // The interface listens further inside. What it does not hear it neither acts on nor keeps from the page around.
  const pass = (event) => taken() || event.stopImmediatePropagation();
  for (const name of ["wheel", "touchstart", "touchmove", "touchend", "touchcancel", "gesturestart", "gesturechange", "gestureend"]) {
    addEventListener(name, pass, { capture: true, passive: true });
  }

  // The program takes the keyboard when it starts.
  const focus = HTMLElement.prototype.focus;
  HTMLElement.prototype.focus = function (options) {
    if (taken()) focus.call(this, options);
  };
}
