// Light or dark: the setting of the system, until the user chooses. It runs before the page is drawn.

(() => {
  const WORDS = { system: "System", light: "Light", dark: "Dark" };
  const dark = matchMedia("(prefers-color-scheme: dark)");
  let chosen = "system";

  const apply = () => {
    document.documentElement.dataset.theme = chosen === "system" ? (dark.matches ? "dark" : "light") : chosen;
  };
  apply();
  dark.addEventListener("change", apply);
  document.addEventListener("DOMContentLoaded", () => {
    const button = document.getElementById("theme");
    const names = Object.keys(WORDS);
    const say = () => {
      const next = names[(names.indexOf(chosen) + 1) % names.length];
      button.querySelector("span").textContent = WORDS[chosen];
      button.setAttribute("aria-label", `Colours of the page: ${WORDS[chosen]}; press for ${WORDS[next]}`);
    };
    say();
    button.onclick = () => {
      chosen = names[(names.indexOf(chosen) + 1) % names.length];
      apply();
      say();
    };
  });
})();
