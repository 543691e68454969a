// Offsets: the library counts bytes of UTF-8, the editor units of UTF-16. Every conversion is here.

const isAscii = (text) => /^[\x00-\x7f]*$/.test(text);

const width = (codePoint) => (codePoint < 0x80 ? 1 : codePoint < 0x800 ? 2 : codePoint < 0x10000 ? 3 : 4);

/** Number of entries that are at most a value, in an ascending list. */
const countUpTo = (list, value) => {
  let low = 0;
  let high = list.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (list[middle] <= value) low = middle + 1;
    else high = middle;
  }
  return low;
};

/** Offsets in one text. An offset inside of a character is moved to its beginning, one beyond the text to its end. */
export class Offsets {
  constructor(text) {
    this.text = text;
    // Ends of all characters that are wider than one byte, in both counts.
    this.units = [];
    this.bytes = [];
    let [unit, byte] = [0, 0];
    if (!isAscii(text)) {
      for (const character of text) {
        const bytes = width(character.codePointAt(0));
        unit += character.length;
        byte += bytes;
        if (bytes > 1) {
          this.units.push(unit);
          this.bytes.push(byte);
        }
      }
    }
    this.size = this.units.length ? byte : text.length;
  }

  /** Converts units of UTF-16 to bytes. */
  byte(unit) {
    const at = Math.max(0, Math.min(unit, this.text.length));
    return this.converted(at, this.units, this.bytes);
  }

  /** Converts bytes to units of UTF-16. */
  unit(byte) {
    const at = Math.max(0, Math.min(byte, this.size));
    return this.converted(at, this.bytes, this.units);
  }

  converted(at, from, to) {
    const before = countUpTo(from, at);
    const [start, result] = before ? [from[before - 1], to[before - 1]] : [0, 0];
    // The next wide character begins where its width says; what is inside of it belongs to its beginning.
    const next = before < from.length ? this.start(before, from, to) : undefined;
    const inside = next && at > next[0] ? next[1] - result : at - start;
    return result + inside;
  }

  /** Beginning of a wide character, in both counts. */
  start(index, from, to) {
    const units = this.units[index];
    const isPair = units >= 2 && /[\udc00-\udfff]/.test(this.text[units - 1]) && /[\ud800-\udbff]/.test(this.text[units - 2]);
    const unit = units - (isPair ? 2 : 1);
    const byte = this.bytes[index] - width(this.text.codePointAt(unit));
    return from === this.units ? [unit, byte] : [byte, unit];
  }
}

let last = new Offsets("");

/** Offsets in a text; those of the last text are kept. */
export const offsetsOf = (text) => {
  if (last.text !== text) last = new Offsets(text);
  return last;
};
