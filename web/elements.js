// The interface as real elements, unseen: what a screen reader reads and a keyboard walks through. The program sends all of them
// (`app::mirror`), and what is done with one goes back to its widget. Elements are kept by id and changed in place, for whoever is
// reading or typing in one must not lose it.

/// How each kind is made: a tag and what never changes of it.
const KINDS = {
  region: ["section", {}],
  group: ["div", { role: "group" }],
  radios: ["div", { role: "radiogroup" }],
  tabs: ["div", { role: "tablist" }],
  menu: ["div", { role: "menu" }],
  list: ["div", { role: "listbox" }],
  dialog: ["div", { role: "dialog", "aria-modal": "true" }],
  button: ["button", { type: "button" }],
  opener: ["button", { type: "button", "aria-haspopup": "listbox" }],
  check: ["input", { type: "checkbox" }],
  radio: ["input", { type: "radio" }],
  tab: ["button", { type: "button", role: "tab" }],
  slider: ["input", { type: "range" }],
  field: ["input", { type: "text", autocomplete: "off", spellcheck: "false" }],
  number: ["input", { type: "text", autocomplete: "off", spellcheck: "false", inputmode: "decimal" }],
  choice: ["div", { role: "option" }],
  item: ["div", { role: "menuitem" }],
  link: ["button", { type: "button", role: "link" }],
  heading: ["div", { role: "heading", "aria-level": "3" }],
  text: ["p", {}],
  picture: ["div", { role: "img" }],
  view: ["div", { role: "application" }],
  progress: ["progress", { max: "1" }],
};
const GROUPS = new Set(["region", "group", "radios", "tabs", "menu", "list", "dialog"]);
const TYPED = new Set(["field", "number"]);
const WRITTEN = new Set(["text", "heading"]);
/// Keys by which each kind is worked that the program hears; all others that are not letters stay with the element.
const ARROWS = ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"];
const KEYS = {
  slider: [...ARROWS, "PageUp", "PageDown", "Home", "End"],
  view: [...ARROWS, "PageUp", "PageDown", "Home", "+", "=", "-", "0", " "],
  item: ["ArrowUp", "ArrowDown"],
  choice: ["ArrowUp", "ArrowDown"],
};
/// Heard wherever no text is typed.
const LETTERS = ["a", "b", "c", "m", "s", "?"];

/// Starts to show elements in `root`, and gives what takes the program's JSON. `core` is the program, `canvas` tells the canvas in use.
export function elements(root, core, canvas) {
  const nodes = new Map();
  let focus = "";
  // What has it from this update on.
  let next = "";
  let asked = null;
  // Whether the keyboard is here, even while the element that had it is gone.
  let here = false;
  let arranging = false;

  const act = (id, what, value = "") => core.mirror_act(id, what, String(value));
  const writing = () => canvas().parentElement.querySelector(":scope > input") ?? {};
  const element = (target) => nodes.get(target?.dataset?.id);

  function make(id, kind) {
    const [tag, fixed] = KINDS[kind];
    const node = document.createElement(tag);
    for (const [name, value] of Object.entries(fixed)) node.setAttribute(name, value);
    node.dataset.id = id;
    node.dataset.kind = kind;
    if (kind === "region") node.append(document.createElement("h2"));
    return { id, kind, node, changed: false };
  }

  function set(node, name, value) {
    if (value === undefined || value === null || value === "") node.removeAttribute(name);
    else if (node.getAttribute(name) !== String(value)) node.setAttribute(name, value);
  }

  function write(node, text) {
    if (node.textContent !== text) node.textContent = text;
  }

  function describe(entry, state) {
    const { node, kind } = entry;
    const { name, description, value, number, min, max, step, on, open, disabled, digits, focusable } = state;
    if (kind === "heading") {
      // The first one in a dialog is its title.
      const dialog = node.closest('[data-kind="dialog"]');
      set(node, "aria-level", dialog?.querySelector('[data-kind="heading"]') === node ? 2 : 3);
    }
    if (WRITTEN.has(kind)) return write(node, name);
    if (kind === "region") write(node.firstChild, name);
    if (kind === "button" || kind === "tab" || kind === "link") write(node, name);
    else if (kind === "opener") write(node, value ? `${name}: ${value}` : name);
    else if (kind === "item" || kind === "choice") write(node, description ? `${name}. ${description}` : name);
    else set(node, "aria-label", kind === "dialog" && !name ? "Window" : name);
    if (kind !== "item" && kind !== "choice") set(node, "aria-description", description);
    if ("disabled" in node) {
      if (node.disabled !== Boolean(disabled)) node.disabled = Boolean(disabled);
    } else set(node, "aria-disabled", disabled ? "true" : null);
    if (kind === "check" || kind === "radio") node.checked = Boolean(on);
    if (kind === "radio") set(node, "name", `radio-${state.within}`);
    if (kind === "tab" || kind === "choice") set(node, "aria-selected", String(Boolean(on)));
    if (kind === "button") {
      set(node, "aria-expanded", open);
      set(node, "aria-pressed", open === undefined ? on : null);
    }
    if (kind === "slider") {
      set(node, "min", min);
      set(node, "max", max);
      set(node, "step", step ?? "any");
      set(node, "aria-valuetext", value);
      if (Number(node.value) !== number) node.value = number;
    }
    if (kind === "progress") node.value = number ?? 0;
    if (kind === "field") {
      set(node, "inputmode", digits ? "decimal" : null);
      // On a phone what is typed goes into the field beside the canvas, and its keyboard comes up.
      if (state.id === next) writing().inputMode = digits ? "decimal" : "text";
    }
    if (TYPED.has(kind) && !entry.changed) {
      const text = value ?? String(number ?? "");
      if (node.value !== text) node.value = text;
    }
    // In Safari buttons have to ask for it.
    if (!GROUPS.has(kind)) set(node, "tabindex", focusable && !disabled ? "0" : null);
  }

  function arrange(list) {
    const present = new Set(list.map((state) => state.id));
    for (const [id, { node }] of nodes) {
      if (present.has(id)) continue;
      node.remove();
      nodes.delete(id);
    }
    const places = new Map();
    for (const state of list) {
      let entry = nodes.get(state.id);
      if (entry && entry.kind !== state.kind && !(TYPED.has(entry.kind) && TYPED.has(state.kind))) {
        entry.node.remove();
        entry = undefined;
      }
      if (!entry) nodes.set(state.id, (entry = make(state.id, state.kind)));
      const parent = nodes.get(state.within)?.node ?? root;
      const place = places.has(parent) ? places.get(parent) : start(parent);
      // Only what is out of its place is moved: an element that is moved loses the keyboard.
      if (entry.node === place) places.set(parent, place.nextSibling);
      else {
        parent.insertBefore(entry.node, place);
        places.set(parent, place);
      }
      describe(entry, state);
    }
  }

  const start = (parent) => (parent.dataset.kind === "region" ? parent.firstChild.nextSibling : parent.firstChild);

  /// What is there no more while a dialog is open: everything beside it.
  function beside() {
    const dialogs = root.querySelectorAll('[data-kind="dialog"]');
    const beside = new Set();
    for (let node = dialogs[dialogs.length - 1]; node && node !== root; node = node.parentElement) {
      for (const other of node.parentElement.children) if (other !== node) beside.add(other);
    }
    return beside;
  }

  /// The keyboard goes where the program has taken it, if it is here at all.
  function follow(now) {
    const active = element(document.activeElement);
    const before = focus;
    focus = now;
    if (!here || (active && active.id === now)) return;
    const entry = nodes.get(now);
    if (entry && now !== before && now !== asked) entry.node.focus({ preventScroll: true });
    else if (active && !entry && before === active.id) keep(active);
    else if (!active) leave();
  }

  const later = (then) => requestAnimationFrame(() => requestAnimationFrame(then));

  /// A field that was left by Enter is still where the keyboard is; but what has just opened may be about to take it.
  function keep(entry) {
    later(() => document.activeElement === entry.node && !nodes.has(focus) && ask(entry.id));
  }

  /// What had the keyboard is gone, and nothing takes it in its place.
  function leave() {
    later(() => {
      if (!here || document.activeElement !== document.body) return;
      here = false;
      core.mirror_focused(false);
      canvas().focus({ preventScroll: true });
    });
  }

  function ask(id) {
    asked = id;
    act(id, "focus");
    act(id, "show");
  }

  root.addEventListener("focusin", ({ target }) => {
    const entry = element(target);
    if (!entry) return;
    if (!here) core.mirror_focused(true);
    here = true;
    if (entry.id !== focus) ask(entry.id);
  });
  root.addEventListener("focusout", ({ target, relatedTarget }) => {
    const entry = element(target);
    if (entry && entry.changed) commit(entry);
    if (root.contains(relatedTarget)) return;
    // An element that goes away takes the keyboard with it; where to is not said yet.
    if (arranging) return;
    here = false;
    core.mirror_focused(false);
  });

  function commit(entry) {
    entry.changed = false;
    core.mirror_key("Enter", false);
  }

  root.addEventListener("click", (event) => {
    const entry = element(event.target);
    if (!entry || GROUPS.has(entry.kind) || TYPED.has(entry.kind) || entry.kind === "slider") return;
    // The program says what comes of it.
    if (entry.kind === "check" || entry.kind === "radio") event.preventDefault();
    act(entry.id, "click");
  });
  root.addEventListener("input", ({ target }) => {
    const entry = element(target);
    if (!entry) return;
    if (entry.kind === "slider") return act(entry.id, "number", target.value);
    if (!TYPED.has(entry.kind)) return;
    if (!entry.changed) act(entry.id, "focus");
    entry.changed = true;
    act(entry.id, "text", target.value);
  });

  function choose(entry, key) {
    const all = [...root.querySelectorAll(`input[name="${entry.node.name}"]`)];
    const step = key === "ArrowRight" || key === "ArrowDown" ? 1 : -1;
    const other = all[(all.indexOf(entry.node) + step + all.length) % all.length];
    other.focus({ preventScroll: true });
    act(other.dataset.id, "click");
  }

  root.addEventListener("keydown", (event) => {
    const entry = element(event.target);
    if (!entry || event.ctrlKey || event.metaKey || event.altKey || event.isComposing) return;
    const { key, shiftKey } = event;
    const pass = () => {
      event.preventDefault();
      core.mirror_key(key, shiftKey);
    };
    if (key === "Escape") {
      entry.changed = false;
      return pass();
    }
    if (TYPED.has(entry.kind)) return key === "Enter" ? (event.preventDefault(), commit(entry)) : undefined;
    if (key === "Tab" && (entry.kind === "item" || entry.kind === "choice")) {
      event.preventDefault();
      return core.mirror_key("Escape", false);
    }
    if (entry.kind === "radio" && ARROWS.includes(key)) {
      event.preventDefault();
      return choose(entry, key);
    }
    if (KEYS[entry.kind]?.includes(key) || LETTERS.includes(key.toLowerCase())) return pass();
    if ((key === "Enter" || key === " ") && !/^(BUTTON|INPUT)$/.test(entry.node.tagName)) {
      event.preventDefault();
      act(entry.id, "click");
    }
  });

  // The interface would keep Tab to itself. It goes on from the widget that has the focus, or from the beginning.
  addEventListener(
    "keydown",
    (event) => {
      if (event.key !== "Tab" || root.contains(event.target) || !canvas().parentElement.contains(event.target)) return;
      event.stopImmediatePropagation();
      nodes.get(focus)?.node.focus({ preventScroll: true });
    },
    true,
  );

  return (json) => {
    const { focus: now, elements: list } = JSON.parse(json);
    next = now;
    arranging = true;
    arrange(list);
    arranging = false;
    const shut = beside();
    for (const node of root.querySelectorAll("[inert]")) node.inert = shut.has(node);
    // What is shut away loses the keyboard, so that goes first.
    follow(now);
    for (const node of shut) node.inert = true;
    asked = null;
  };
}
