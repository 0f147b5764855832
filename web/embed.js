// In the frame of another page: wheel, fingers and keys are that page's until the person clicks in, and again once they click outside.

/// How far a finger goes before one can tell along which way, CSS pixels.
const KNOWN = 8;

/// Begins to leave to the page around this one what is not meant for this one. Does nothing in a page of its own. `core` tells the program,
/// or null as long as it is not there.
export function passThrough(core) {
  if (window.parent === window) return;
  const { classList } = document.documentElement;
  classList.add("framed");
  const taken = () => classList.contains("taken");
  const take = () => classList.add("taken");
  const leave = () => classList.remove("taken");

  const wanted = ({ clientX, clientY }) => {
    const { left, top } = document.getElementById("canvas").getBoundingClientRect();
    return Boolean(core()?.wants_finger(clientX - left, clientY - top));
  };
  // Whether the fingers that are down are for this page. A finger of which that is not known yet may be about to scroll. Going across,
  // or lifted in its place, it was for this page, which hears of it then.
  let mine = false;
  let held = null;
  const deliver = () => {
    const down = held;
    held = null;
    if (down) down.target.dispatchEvent(new PointerEvent("pointerdown", down));
  };
  const press = (event) => {
    if (!event.isTrusted) return;
    if (event.pointerType === "mouse") return take();
    if (event.isPrimary) {
      mine = taken() && wanted(event);
      held = mine ? null : event;
    }
    if (!mine) event.stopImmediatePropagation();
  };
  const move = (event) => {
    if (!held || !taken() || event.pointerId !== held.pointerId) return;
    const across = Math.abs(event.clientX - held.clientX);
    if (across < KNOWN || across < Math.abs(event.clientY - held.clientY)) return;
    mine = true;
    deliver();
  };
  const release = (event) => {
    if (!held || event.pointerId !== held.pointerId) return;
    take();
    deliver();
  };
  addEventListener("pointerdown", press, true);
  addEventListener("pointermove", move, true);
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
  const passWhere = (ours, names) => {
    const pass = (event) => {
      if (!ours()) return event.stopImmediatePropagation();
      // The interface would keep the browser from what it is at already, which is told as an error.
      if (!event.cancelable) event.preventDefault = () => {};
    };
    for (const name of names) addEventListener(name, pass, { capture: true, passive: true });
  };
  passWhere(taken, ["wheel", "gesturestart", "gesturechange", "gestureend"]);
  passWhere(() => mine, ["touchstart", "touchmove", "touchend", "touchcancel"]);

  // The program takes the keyboard when it starts.
  const focus = HTMLElement.prototype.focus;
  HTMLElement.prototype.focus = function (options) {
    if (taken()) focus.call(this, options);
  };
}
