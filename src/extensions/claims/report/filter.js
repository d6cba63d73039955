const form = document.getElementById("filter");
const rows = [...document.querySelectorAll("tr[data-verdict]")];
const shown = document.getElementById("shown");

function filter() {
  const verdict = form.verdict.value;
  const words = form.words.value.toLowerCase().split(/\s+/);
  let count = 0;
  for (const row of rows) {
    // The dot above a letter is found as it is typed.
    const text = row.textContent.toLowerCase().normalize("NFD").replaceAll("\u0307", "dot");
    const fits = (!verdict || row.dataset.verdict === verdict) && words.every((w) => text.includes(w));
    row.hidden = !fits;
    count += fits;
  }
  shown.textContent = `${count} of ${rows.length}`;
}

// A link to a statement shows it, whatever the filter is.
function reveal() {
  const row = document.getElementById(location.hash.slice(1));
  if (rows.includes(row)) {
    form.reset();
    filter();
    form.parentElement.open = true;
    row.scrollIntoView();
  }
}

if (form) {
  form.hidden = false;
  form.addEventListener("input", filter);
  form.addEventListener("submit", (event) => event.preventDefault());
  addEventListener("hashchange", reveal);
  for (const link of document.querySelectorAll("[data-pick]")) {
    link.addEventListener("click", () => {
      form.reset();
      form.verdict.value = link.dataset.pick;
      form.parentElement.open = true;
      filter();
    });
  }
  filter();
  reveal();
}
