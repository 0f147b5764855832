// How far the person has come in the lessons. It stays in this browser.

const KEY = "centrode.progress";

/// What was kept; "" when that is nothing yet, undefined where the browser keeps nothing.
export function kept() {
  try {
    return localStorage.getItem(KEY) ?? "";
  } catch {
    return undefined;
  }
}

/// Keeps a text; false where the browser refuses.
export function keep(text) {
  try {
    localStorage.setItem(KEY, text);
    return true;
  } catch {
    return false;
  }
}
