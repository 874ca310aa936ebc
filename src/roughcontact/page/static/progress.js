// How far the worker is: words when a task begins, and a bar while it goes on.

export function progressBar(bar, say) {
  return {
    // Events come of tasks that last; a short one is no more than its words.
    heard({ task, state, done, total, level }) {
      if (!level && state === "started") say(`${task} …`);
      if (state !== "running") return;
      bar.classList.remove("idle");
      if (total) [bar.max, bar.value] = [total, done];
      else bar.removeAttribute("value");
    },
    end: () => bar.classList.add("idle"),
  };
}
