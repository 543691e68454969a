// Answers take the place of what a page shows. A page in a file has one answer, and not this script.

/// Returns `update(answer)`, `messages(all, isOld)` and, with a provider, the `questions` to it.
mount.answering = ({ root, part, clock, controls, pulling, question, take, takeSections }, provider, signal) => {
  /// Marks the picture as one of other values than those that are asked for.
  const reasons = new Set();
  const mark = (reason, isSet) => {
    if (isSet) reasons.add(reason);
    else reasons.delete(reason);
    root.classList.toggle("old", reasons.size > 0);
    part("drawing").setAttribute("aria-busy", String(reasons.has("late")));
  };

  const messages = (all, isOld) => {
    const rows = all.map((own) => {
      const title = made("b", {}, own.severity === "error" ? "Error:" : "Warning:");
      const isBlock = own.text.includes("\n");
      return isBlock
        ? made("pre", { class: own.severity, tabindex: 0, "data-code": own.code }, own.text)
        : made("p", { class: own.severity, "data-code": own.code }, title, ` ${own.text}`);
    });
    part("messages").replaceChildren(...rows);
    mark("failed", isOld);
  };

  const update = (answer) => {
    const isMotion = Array.isArray(answer.assemblies);
    if (isMotion) {
      if (answer.lead !== undefined) part("lead").innerHTML = answer.lead;
      if (answer.title) root.querySelector("h1").textContent = answer.title;
      if (answer.sketch) replaceMechanism(part("drawing"), answer.drawing);
      else if (answer.drawing) replaceDrawing(part("drawing"), answer.drawing);
      if (answer.pulled) {
        controls.set(Object.fromEntries(answer.pulled.values));
        clock.t = answer.pulled.t;
      }
      take(answer);
    }
    if (answer.sections) {
      replaceSections(root, answer.sections);
      takeSections();
      // Messages are those of the motion.
      if (!isMotion) return;
    }
    if (answer.controls) controls.take(answer);
    messages(answer.messages ?? [], !isMotion && (answer.messages ?? []).some((it) => it.severity === "error"));
  };

  const answers = {
    question: (detail) => {
      const pull = detail === "sections" ? null : pulling.question();
      return { ...question(detail), ...(pull && { pull }) };
    },
    answered: (answer) => update(answer),
    failed: (error) => messages([{ severity: "error", code: "", text: error.message }], true),
    marked: (isOld) => mark("late", isOld),
  };
  return { update, messages, questions: provider && new Questions(provider, answers, signal) };
};
