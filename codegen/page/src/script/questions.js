// Questions to a provider: at most one is under way of what moves, and then the newest is asked.

/// Time after which an answer that has not come makes the picture an old one, and time of rest before a complete question, in ms.
const [LATE, REST] = [200, 150];

class Questions {
  /// `question` gives what is asked now with a detail, `answered` takes an answer, `failed` an error, `marked` is told whether the picture is old.
  constructor(provider, { question, answered, failed, marked }, signal) {
    Object.assign(this, { provider, question, answered, failed, marked, signal, next: null, current: null, round: 0, isHeld: false });
    signal.addEventListener("abort", () => {
      clearTimeout(this.resting);
      clearTimeout(this.late);
    });
  }

  /// Asks while something moves, and completely once it rests.
  moving() {
    clearTimeout(this.resting);
    this.isWaiting = true;
    if (!this.isHeld) this.resting = setTimeout(() => this.ask("resting"), REST);
    this.ask("moving");
  }

  /// While something is held, nothing is asked completely: the picture keeps its scale below the pointer.
  hold(isHeld) {
    this.isHeld = isHeld;
    clearTimeout(this.resting);
    if (!isHeld && this.isWaiting) this.ask("resting");
  }

  async ask(detail) {
    if (this.signal.aborted) return;
    if (detail === "resting") {
      clearTimeout(this.resting);
      this.isWaiting = false;
    }
    this.next = detail;
    // What moves does not wait for an answer about what rested, which is left out then.
    if (this.current && !(detail === "moving" && this.current !== "moving")) return;
    this.round += 1;
    const { round } = this;
    while (this.next && round === this.round && !this.signal.aborted) await this.put(round);
    if (round === this.round) this.current = null;
  }

  async put(round) {
    const detail = this.next;
    const isLeftOut = () => this.signal.aborted || round !== this.round;
    this.next = null;
    this.current = detail;
    clearTimeout(this.late);
    // Sections leave the picture as it is.
    if (detail !== "sections") this.late = setTimeout(() => this.marked(true), LATE);
    try {
      const answer = await this.provider.ask(this.question(detail));
      if (isLeftOut()) return;
      this.answered(answer);
      // Text follows when nothing newer is asked.
      if (detail === "resting") this.next ??= "sections";
    } catch (error) {
      if (isLeftOut()) return;
      this.failed(error);
    }
    clearTimeout(this.late);
    this.marked(false);
  }
}
