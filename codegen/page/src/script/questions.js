// Questions to a provider: at most one is under way, and then the newest is asked.

/// Time after which an answer that has not come makes the picture an old one, and time of rest before a complete question, in ms.
const [LATE, REST] = [200, 150];

class Questions {
  /// `question` gives what is asked now with a detail, `answered` takes an answer, `failed` an error, `marked` is told whether the picture is old.
  constructor(provider, { question, answered, failed, marked }, signal) {
    Object.assign(this, { provider, question, answered, failed, marked, signal, next: null, isBusy: false, isHeld: false });
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
    if (this.isBusy) return;
    this.isBusy = true;
    while (this.next && !this.signal.aborted) await this.put();
    this.isBusy = false;
  }

  async put() {
    const detail = this.next;
    this.next = null;
    // Sections leave the picture as it is.
    if (detail !== "sections") this.late = setTimeout(() => this.marked(true), LATE);
    try {
      const answer = await this.provider.ask(this.question(detail));
      if (this.signal.aborted) return;
      this.answered(answer);
      // Text follows when nothing newer is asked.
      if (detail === "resting") this.next ??= "sections";
    } catch (error) {
      if (!this.signal.aborted) this.failed(error);
    }
    clearTimeout(this.late);
    if (!this.signal.aborted) this.marked(false);
  }
}
