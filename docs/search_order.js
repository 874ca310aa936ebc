// Order of what the search finds: by how much of the question stands in a title, by how much else stands there, and by
// the kind of page.
var Scorer = {
  objNameMatch: 11,
  objPartialMatch: 6,
  objPrio: { 0: 5, 1: 5, 2: -5 },
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,

  // By itself Sphinx counts the best of the words alone: a page with one of three in some heading stands beside a page with
  // all three in its title, and the alphabet decides.
  score: ([page, title, anchor, about, score]) => {
    const skipped = new Set(stopwords);
    const stems = (text) =>
      splitQuery(text.toLowerCase())
        .filter((word) => !skipped.has(word))
        .map((word) => new Stemmer().stemWord(word));
    const asked = stems(new URLSearchParams(window.location.search).get("q") || "");
    const named = new Set(stems(title));
    const found = asked.filter((word) => named.has(word)).length;
    const behind = { gallery: 3, api: 6, project: 9 }[page.split("/")[0]] || 0;
    return score + (20 * found) / Math.max(asked.length, 1) + (5 * found) / Math.max(named.size, 1) - behind;
  },
};
