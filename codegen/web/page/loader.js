"use strict";
// Unpacks the scripts of the page, and starts them. What a saved page is made of is read before anything changes.

globalThis.linkwright = { original: `<!DOCTYPE html>\n${document.documentElement.outerHTML}` };
(async () => {
  const letters = atob(document.getElementById("parts").textContent);
  const packed = new Uint8Array(letters.length);
  for (let index = 0; index < letters.length; index += 1) packed[index] = letters.charCodeAt(index);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  linkwright.parts = JSON.parse(await new Response(stream).text());
  for (const text of linkwright.parts.scripts) {
    const script = document.createElement("script");
    script.textContent = text;
    document.head.append(script);
  }
})();
