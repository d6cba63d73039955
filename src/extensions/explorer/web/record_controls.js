/* Buttons that copy and save what the page shows, and the check of its bits. */
function listenToRecord(page) {
  on("copy-scene", "click", async () => {
    const kind = element("scene-kind").value;
    const block = sceneBlock(kind, page);
    element("scene").value = block.text;
    const copied = await copyText(block.text, element("scene"));
    const first = copied ? "Copied." : "Copy the lines above.";
    setText("scene-note",
      `${first} Paste them under scenes: in config.yaml, and run ./reproduce ${block.name}. ${block.note}`);
  });
  for (const [id, all] of [["csv", false], ["csv-all", true]]) {
    on(id, "click", async () => {
      const orbits = (all ? page.orbits : [page.orbits[page.state.chosen]]).filter((orbit) => orbit?.count);
      if (!orbits.length) {
        setText("record-note", all ? "Start an orbit first." : "Choose an orbit first.");
        return;
      }
      const name = all ? "orbits.csv" : "orbit.csv";
      download(name, await orbitsCsv(page, orbits));
      const count = orbits.reduce((sum, orbit) => sum + orbit.count, 0);
      setText("record-note", `${name} has ${COUNT.format(count)} impacts after the start, to the last bit.`);
    });
  }
  for (const [id, ratio, name] of [["png2", 2, "section-2x.png"],
    ["png4", 4, "section-4x.png"], ["svg", null, "section.svg"]]) {
    on(id, "click", async () => {
      download(name, await picture(page, ratio));
      setText("record-note", `${name} has the section as it is drawn, with k, g, E and the address.`);
    });
  }
  on("link", "click", async () => {
    page.save();
    const field = element("address");
    field.value = window.location.href;
    const copied = await copyText(field.value, field);
    setText("record-note", copied ? "The link is copied." : "Copy the link above.");
  });
  on("check", "click", () => check(page));
}

/** Compute the orbits of published figures here, and say whether they have the committed bits. */
async function check(page) {
  element("check").disabled = true;
  const found = [];
  page.checker ??= new Computer(); // of its own, which no change of the picture interrupts
  try {
    for (const figure of page.data.check) {
      const name = `Figure ${figure.figure.replace("fig", "")}`;
      setText("check-note", `Computing ${name} …`);
      const result = await page.checker.ask("check", { figure });
      const count = COUNT.format(result.impacts);
      const { different } = result;
      const bits = different.length ? "other bits here" : "the same bits here";
      const where = different.length ? `, of ${different.join(", ")}` : "";
      found.push(`${name}: ${bits}, in ${count} impacts${where}.`);
    }
  } catch (error) {
    found.push(`The check could not be done: ${error.message}.`);
  }
  setText("check-note", found.join(" "));
  element("check").disabled = false;
}
