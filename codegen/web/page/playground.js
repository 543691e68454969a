// The playground: a description on the left, its mechanism on the right.

/// Time of rest before the address is renewed, in ms.
const RENEWAL = 600;

const { original, parts } = globalThis.linkwright;
const stored = (id) => document.getElementById(id).textContent;
const bar = (name) => document.querySelector(`[data-bar="${name}"]`);

const playground = async () => {
  const { gallery, worker } = parts;
  const start = (await stateOf(location.hash)) ?? checkedState(JSON.parse(stored("start"))) ?? checkedState(gallery[0]);
  const solver = new Solver(worker, stored("solver"));
  // What rests takes longer, and has a thread of its own, so that what moves never waits for it.
  const patient = new Solver(worker, stored("solver"));
  const pane = document.getElementById("pane-mechanism");
  let { files, motion, units } = start;
  let page = null;
  let dragging = null;
  /// Text that the drawing is of.
  let drawnOf = null;

  const about = (text = editor.text()) => ({ text, files, motion, units });
  const note = (words) => {
    bar("note").textContent = words;
  };

  const editor = createEditor(bar("editor"), {
    text: start.text,
    change: () => changed(),
    tokens: (text) => solver.request("tokens", { tokens: text }),
    complete: (text, offset) => solver.request("complete", { complete: { text, offset } }),
    hover: (text, offset) => solver.request("hover", { hover: { question: about(text), offset } }),
  });

  /// Offers the motions of a description that has several. They are listed by an answer to a question that names none.
  const listMotions = (names) => {
    if (motion) return;
    const list = bar("motion");
    list.closest("label").hidden = names.length === 0;
    if (list.dataset.names === names.join()) return;
    list.dataset.names = names.join();
    list.replaceChildren(...names.map((it) => made("option", { value: it }, it)));
  };
  bar("motion").addEventListener("change", ({ target }) => {
    motion = target.value;
    page?.forget();
    changed();
  });

  const provider = {
    ask: async (question) => {
      const text = editor.text();
      const answer = await (question.detail === "moving" ? solver : patient).request(`ask ${question.detail}`, { ask: { ...question, ...about(text) } });
      if (answer.refused) throw new Error(answer.refused);
      editor.show(answer.messages ?? [], text);
      listMotions(answer.motions ?? []);
      if (answer.assemblies) drawnOf = text;
      return answer;
    },
  };

  pane.innerHTML = await solver.request("skeleton", "skeleton");
  const root = pane.firstElementChild;

  const hooks = {
    text: () => editor.text(),
    isCurrent: () => drawnOf === editor.text(),
    isGiven: () => Object.keys(page.question().values).length === 0,
    handles: (text) => solver.request("handles", { handles: about(text) }),
    move: (text, handle, position) => solver.request("move", { move: { question: about(text), handle, position } }),
    replace: (changes, isJoined) => editor.replace(changes, isJoined),
    undo: () => editor.undo(),
    hold: (isHeld) => page.hold(isHeld),
  };

  /// Shows the first answer that has a motion; until then, only its messages.
  const begin = async () => {
    const { values, assembly, range } = start;
    const question = { values, assembly, ...(range ? { range } : {}), detail: "moving" };
    const answer = await provider.ask(question).catch((error) => ({ messages: [{ severity: "error", text: error.message }] }));
    if (!answer.assemblies) {
      root.querySelector("[data-part=messages]").replaceChildren(...(answer.messages ?? []).map((it) => made("p", { class: it.severity }, it.text)));
      document.body.dataset.ready = "";
      return;
    }
    root.querySelector("[data-part=messages]").replaceChildren();
    root.querySelector("h1").textContent = answer.title;
    root.querySelector("[data-part=drawing]").innerHTML = answer.drawing;
    page = mount(root, answer, provider);
    page.choose(values);
    page.ask("resting");
    dragging = new Dragging(page.scene, hooks, new AbortController().signal);
    document.body.dataset.ready = "";
  };

  let renewal = 0;
  const state = () => {
    const { values, range, assembly } = page?.question() ?? start;
    // That of the design configuration needs no label.
    return { ...about(), values, range, assembly: assembly?.endsWith("as drawn") ? null : assembly };
  };
  const renew = () => {
    clearTimeout(renewal);
    renewal = setTimeout(async () => history.replaceState(null, "", `#${await addressOf(state())}`), RENEWAL);
  };
  const changed = () => {
    note("");
    if (page) page.change();
    else begin();
    dragging?.refresh();
    refresh();
    renew();
  };

  // Panes beside the mechanism are filled when they are looked at.
  const panes = {
    check: async () => {
      const { text, messages } = await patient.request("check", { check: { ...(page?.question() ?? {}), ...about() } });
      return text || messages.map((it) => it.text).join("\n");
    },
    rust: () => code("rust"),
    c: () => code("c"),
  };
  const code = async (language) => {
    const { files: all, messages } = await patient.request(language, { code: { question: about(), language } });
    return all.length ? all.map(([, text]) => text).join("\n") : messages.map((it) => it.text).join("\n");
  };
  let selected = "mechanism";
  const refresh = async () => {
    const fill = panes[selected];
    if (!fill) return;
    const name = selected;
    const text = await fill().catch((error) => error.message);
    document.querySelector(`#pane-${name} > pre`).textContent = text;
  };
  const tabs = [...document.querySelectorAll("[role=tab]")];
  const select = (tab) => {
    selected = tab.id.replace("tab-", "");
    for (const other of tabs) {
      const isSelected = other === tab;
      other.setAttribute("aria-selected", String(isSelected));
      other.tabIndex = isSelected ? 0 : -1;
      document.getElementById(other.getAttribute("aria-controls")).hidden = !isSelected;
    }
    refresh();
  };
  tabs.forEach((tab, index) => {
    tab.addEventListener("click", () => select(tab));
    tab.addEventListener("keydown", (event) => {
      const way = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (!way) return;
      const next = tabs[(index + way + tabs.length) % tabs.length];
      select(next);
      next.focus();
    });
  });

  const download = (name, contents, type) => {
    const link = made("a", { href: URL.createObjectURL(new Blob(contents, { type })), download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  };
  const name = () => editor.text().match(/\bmechanism\s+(\w+)/)?.[1] ?? "mechanism";
  const downloads = {
    mech: () => download(`${name()}.mech`, [editor.text()], "text/plain"),
    rust: async () => generated("rust"),
    c: async () => generated("c"),
    latex: async () => downloadText("latex", `${name()}.tex`, { latex: about() }),
    csv: async () => downloadText("csv", `${name()}.csv`, { csv: { ...page.question(), ...about() } }),
    svg: () => {
      const svg = root.querySelector("[data-part=drawing] svg").cloneNode(true);
      svg.querySelectorAll(".lit").forEach((it) => it.classList.remove("lit"));
      svg.querySelector(".handles")?.remove();
      download(`${name()}.svg`, [new XMLSerializer().serializeToString(svg)], "image/svg+xml");
    },
  };
  const generated = async (language) => {
    const { files: all, messages } = await patient.request(language, { code: { question: about(), language } });
    if (all.length === 0) return note(messages.map((it) => it.text).join(" "));
    return all.forEach(([file, text]) => download(file, [text], "text/plain"));
  };
  const downloadText = async (kind, file, request) => {
    const { text, messages } = await patient.request(kind, request);
    if (messages.length && !text) return note(messages.map((it) => it.text).join(" "));
    return download(file, [text], "text/plain");
  };
  bar("download").addEventListener("change", async ({ target }) => {
    const { value } = target;
    target.value = "";
    try {
      await downloads[value]?.();
    } catch (error) {
      note(error.message);
    }
  });

  bar("undo").addEventListener("click", () => editor.undo());
  bar("redo").addEventListener("click", () => editor.redo());
  bar("share").addEventListener("click", async () => {
    history.replaceState(null, "", `#${await addressOf(state())}`);
    const isCopied = await navigator.clipboard?.writeText(location.href).then(() => true, () => false);
    note(isCopied ? "The address is copied." : "The address of this page holds everything.");
  });
  bar("save").addEventListener("click", () => download(`${name()}.html`, [pageWith(original, { ...state(), isPage: true })], "text/html"));

  const showSource = (isShown) => {
    document.querySelector(".split").classList.toggle("whole", !isShown);
    bar("source").setAttribute("aria-expanded", String(isShown));
  };
  bar("source").addEventListener("click", () => showSource(document.querySelector(".split").classList.contains("whole")));
  showSource(!start.isPage);

  gallery.forEach((it, index) => bar("gallery").append(made("option", { value: index }, it.name)));
  bar("gallery").addEventListener("change", ({ target }) => {
    const chosen = checkedState(gallery[target.value]);
    target.value = "";
    if (!chosen) return;
    ({ files, motion, units } = chosen);
    page?.forget();
    const end = new TextEncoder().encode(editor.text()).length;
    editor.replace([{ start: 0, end, text: chosen.text }]);
  });
  addEventListener("hashchange", async () => {
    const next = await stateOf(location.hash);
    if (!next || JSON.stringify(next.text) === JSON.stringify(editor.text())) return;
    ({ files, motion, units } = next);
    page?.forget();
    const end = new TextEncoder().encode(editor.text()).length;
    editor.replace([{ start: 0, end, text: next.text }]);
  });
  globalThis.linkwright = { editor, solver, patient, page: () => page };
  await begin();
};

playground();
