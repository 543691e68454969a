"use strict";
// The server says when there is a newer version of this page; what was looked at stays where it was.
(() => {
  const kept = "linkwright";
  const time = document.querySelector("[data-part=time]");
  try {
    const was = JSON.parse(sessionStorage.getItem(kept) ?? "null");
    sessionStorage.removeItem(kept);
    if (was && time) {
      time.value = was.t;
      time.dispatchEvent(new Event("input"));
      scrollTo(0, was.y);
    }
  } catch { /* Nothing was kept. */ }
  const source = new EventSource("/changes?after=VERSION");
  source.onmessage = () => {
    source.close();
    sessionStorage.setItem(kept, JSON.stringify({ t: time ? time.value : 0, y: scrollY }));
    location.reload();
  };
})();
