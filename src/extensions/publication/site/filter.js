// The filter of the paper's statements: a bar of the verdicts, and fields for a verdict and words.
const statements = [...document.querySelectorAll('section[id^="statement-"]')];
const verdictOf = (statement) => statement.parentElement;
const verdicts = [...new Set(statements.map(verdictOf))];
const COLOURS = ["#c0392b", "#e1a100", "#8a8a8a", "#0b6e4f", "#4fa3d1", "#cfcfcf"];
const wordOf = (verdict) => verdict.querySelector("h2").firstChild.textContent;

function filter(form, shown) {
  const words = form.words.value.toLowerCase().split(/\s+/);
  let count = 0;
  for (const statement of statements) {
    const text = statement.textContent.toLowerCase();
    const fits = !form.verdict.value || wordOf(verdictOf(statement)) === form.verdict.value;
    statement.hidden = !(fits && words.every((word) => text.includes(word)));
    count += !statement.hidden;
  }
  for (const each of verdicts) each.hidden = !each.querySelector("section:not([hidden])");
  shown.textContent = `${count} of ${statements.length}`;
}

if (statements.length) {
  const form = document.createElement("form");
  const bar = document.createElement("div");
  form.className = "filter";
  bar.className = "bar";
  form.innerHTML =
    '<label>Verdict <select name="verdict"><option value="">all</option></select></label>' +
    '<label>Words <input type="search" name="words"></label><output></output>';
  verdicts.forEach((verdict, i) => {
    const [word, count] = [wordOf(verdict), verdict.querySelectorAll("section").length];
    form.verdict.add(new Option(word));
    const link = Object.assign(document.createElement("a"), { href: `#${verdict.id}`, title: `${word}: ${count}` });
    link.setAttribute("aria-label", link.title);
    link.style.cssText = `--part: ${COLOURS[i % COLOURS.length]}; flex-grow: ${count}`;
    bar.append(link);
  });
  verdicts[0].before(bar, form);
  const apply = () => filter(form, form.querySelector("output"));
  form.addEventListener("input", apply);
  form.addEventListener("submit", (event) => event.preventDefault());
  // A link to a statement shows it, whatever the filter is.
  addEventListener("hashchange", () => {
    const target = document.getElementById(location.hash.slice(1));
    if (target?.closest("[hidden]")) {
      form.reset();
      apply();
      target.scrollIntoView();
    }
  });
  apply();
}
