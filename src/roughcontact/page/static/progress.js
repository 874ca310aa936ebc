// The progress of the worker: words during an outer task, and a bar if it takes long.

export function progressBar(bar, said) {
  let before = "";
  return {
    heard({ task, state, done, total, level }) {
      const words = `${task} …`;
      if (!level && state === "started") {
        before = said.textContent.endsWith("…") ? "" : said.textContent;
        said.textContent = words;
      }
      if (!level && /finished|stopped/.test(state) && said.textContent === words) said.textContent = before; // a warning
      if (state !== "running") return;
      bar.classList.remove("idle");
      if (total) [bar.max, bar.value] = [total, done];
      else bar.removeAttribute("value");
    },
    end: () => bar.classList.add("idle"),
  };
}
