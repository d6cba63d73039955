/* The tour and the questions: steps that show a state of the page, and say or ask something there. */
class Guide extends OfPage {
  constructor(page) {
    super(page);
    on("tour-start", "click", () => this.turn("tour", 1));
    on("lesson-start", "click", () => this.turn("lesson", 1));
    on("guide-back", "click", () => this.turn(this.kind, this.number - 1));
    on("guide-next", "click", () => this.turn(this.kind, this.number + 1));
    on("guide-end", "click", () => this.end());
    on("guide-link", "click", () => this.copyLink());
    on("reveal", "click", () => this.reveal());
    on("try", "submit", (event) => {
      event.preventDefault();
      const { from, to } = this.step.answer;
      const guess = readNumber(element("guess").value);
      this.judge(Number.isNaN(guess) ? null : guess >= from && guess <= to);
    });
  }

  get kind() { return this.state.lesson ? "lesson" : "tour"; }
  get number() { return this.state[this.kind]; }
  get steps() { return this.page.data[this.kind]; }
  get step() { return this.steps[this.number - 1]; }

  /** Go to a step of the tour or to a question; after the last one it ends. */
  turn(kind, number) {
    const step = this.page.data[kind][number - 1];
    if (step) this.page.controls.turnTo({ ...readAddress(step.address), [kind]: number });
    else this.end();
  }

  end() {
    this.page.mark();
    Object.assign(this.state, { tour: 0, lesson: 0, revealed: false });
    this.show();
    this.page.controls.welcome();
    this.page.section.drawLines();
    this.page.saveSoon();
  }

  show() {
    const { lesson, revealed } = this.state;
    const { number, steps, step } = this;
    document.body.classList.toggle("guided", number > 0);
    element("guide").hidden = !number;
    if (!number) return;
    setText("guide-title", `${number} of ${steps.length}. ${step.title}`);
    setText("guide-text", revealed ? step.why : step.text);
    element("guide-back").disabled = number === 1;
    element("guide-next").textContent = number < steps.length ? "Next" : "Finish";
    element("guide-link").hidden = !lesson;
    element("try").hidden = !lesson || revealed;
    if (!lesson) return;
    const choices = step.choices ?? [];
    const choice = (text, i) => button(text, text, () => this.judge(i === step.answer));
    element("choices").replaceChildren(...choices.map(choice));
    for (const id of ["guess-label", "answer"]) element(id).hidden = choices.length > 0;
    element("guess").value = "";
  }

  /** Say whether an answer is right; null is no answer. A right one is explained. */
  judge(right) {
    const { text, why } = this.step;
    if (right) {
      this.reveal();
      setText("guide-text", `Right. ${why}`);
    } else setText("guide-text", `${right === null ? "Type a number." : "No, that is not it."} ${text}`);
  }

  reveal() {
    const { lesson } = this.state;
    this.page.controls.turnTo({ ...readAddress(this.step.reveal), lesson, revealed: true });
  }

  async copyLink() {
    const field = element("address");
    const { href } = window.location;
    field.value = `${href.split("#")[0]}#${this.step.address}&lesson=${this.number}`;
    const copied = await copyText(field.value, field);
    this.hint(copied ? "The link to this question is copied." : "The link is in the panel Export.");
  }
}
