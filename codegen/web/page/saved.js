// What a page holds, for addresses and files. Nothing in it is trusted: every part has a type and a size.

/// Largest number of letters of an address, and of bytes of what it holds.
const [LONGEST, LARGEST_STATE] = [400_000, 2_000_000];

const isText = (value) => typeof value === "string" && value.length <= LARGEST_STATE;
const isRecord = (value) => value !== null && typeof value === "object" && !Array.isArray(value);
const textsOf = (value) => (isRecord(value) ? Object.fromEntries(Object.entries(value).filter(([, it]) => isText(it))) : {});

/// The parts of a state that can be used; null if there is no description.
const checkedState = (value) => {
  if (!isRecord(value) || !isText(value.text)) return null;
  const times = isRecord(value.range) ? [value.range.from, value.range.to, value.range.step] : [];
  const [from, to, step] = times.every(Number.isFinite) ? times : [];
  return {
    text: value.text,
    files: textsOf(value.files),
    motion: isText(value.motion) ? value.motion : null,
    units: isText(value.units) ? value.units : null,
    values: textsOf(value.values),
    assembly: isText(value.assembly) ? value.assembly : null,
    range: times.length === 3 && to > from && step > 0 ? { from, to, step } : null,
    isPage: value.isPage === true,
  };
};

const through = async (bytes, transform, limit = Infinity) => {
  const reader = new Blob([bytes]).stream().pipeThrough(transform).getReader();
  const chunks = [];
  let size = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    size += value.length;
    if (size > limit) {
      await reader.cancel();
      throw new Error("the address holds too much");
    }
    chunks.push(value);
  }
  return new Uint8Array(await new Blob(chunks).arrayBuffer());
};

/// A state as the fragment of an address: JSON, compressed, in letters that addresses may have.
const addressOf = async (state) => {
  const packed = await through(new TextEncoder().encode(JSON.stringify(state)), new CompressionStream("deflate-raw"));
  let letters = "";
  for (let at = 0; at < packed.length; at += 0x8000) letters += String.fromCharCode(...packed.subarray(at, at + 0x8000));
  return btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
};

/// The state in the fragment of an address; null if there is none.
const stateOf = async (fragment) => {
  const letters = fragment.replace(/^#/, "");
  if (letters === "" || letters.length > LONGEST || !/^[\w-]+$/.test(letters)) return null;
  try {
    const packed = Uint8Array.from(atob(letters.replaceAll("-", "+").replaceAll("_", "/")), (it) => it.charCodeAt(0));
    const bytes = await through(packed, new DecompressionStream("deflate-raw"), LARGEST_STATE);
    return checkedState(JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(bytes)));
  } catch {
    return null;
  }
};

/// The page as it was loaded, with another state inside.
const pageWith = (page, state) => {
  const json = JSON.stringify(state).replaceAll("<", "\\u003c");
  return page.replace(/(<script type="application\/json" id="start">)[^<]*(<\/script>)/, (_, before, after) => before + json + after);
};
