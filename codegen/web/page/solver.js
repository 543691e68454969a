// Requests to the solver: one is under way, the others wait. A solver that takes too long is ended, and the next request starts another.

/// Longest time for a reply, in ms.
const PATIENCE = 15000;

class Solver {
  /// `script` is the text of the worker, `packed` its module: gzip in base 85.
  constructor(script, packed) {
    this.url = URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
    Object.assign(this, { packed, limit: PATIENCE, worker: null, current: null, waiting: [] });
  }

  /// The reply to a request. A newer request of the same kind takes the place of one that waits, whose reply is then that of the newer.
  request(kind, body) {
    const text = JSON.stringify(body);
    return new Promise((resolve, reject) => {
      const same = this.waiting.find((it) => it.kind === kind);
      if (same) {
        same.text = text;
        same.settled.push({ resolve, reject });
      } else this.waiting.push({ kind, text, settled: [{ resolve, reject }] });
      this.next();
    });
  }

  next() {
    if (this.current || this.waiting.length === 0) return;
    this.current = this.waiting.shift();
    this.worker ??= this.start();
    this.worker.postMessage({ request: this.current.text });
    this.patience = setTimeout(() => this.fail(`this takes longer than ${this.limit / 1000} s`), this.limit);
  }

  start() {
    const worker = new Worker(this.url);
    worker.onmessage = ({ data }) => this.finish((it) => it.resolve(JSON.parse(data)));
    worker.onerror = (event) => {
      event.preventDefault();
      this.fail(`the solver has ended: ${event.message}`);
    };
    worker.postMessage({ packed: this.packed });
    return worker;
  }

  fail(reason) {
    this.worker?.terminate();
    this.worker = null;
    this.finish((it) => it.reject(new Error(reason)));
  }

  finish(settle) {
    clearTimeout(this.patience);
    const { settled } = this.current;
    this.current = null;
    settled.forEach(settle);
    this.next();
  }
}
