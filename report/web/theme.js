const darkness = window.matchMedia("(prefers-color-scheme: dark)");

/** The present colour of the style sheet by name: "c0" … "c6", "text", "rule", … */
export function color(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

export const lineColor = (index) => color(`c${index % 7}`);

export function watchTheme(listener) {
  darkness.addEventListener("change", listener);
}
