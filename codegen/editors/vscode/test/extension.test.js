// Does the extension start the server of the setting, for descriptions, and end it?

"use strict";

const assert = require("node:assert");
const Module = require("node:module");
const { test } = require("node:test");

/// Something that has whatever is asked of it, as the editor has.
function anything() {
  return new Proxy(class {}, {
    get: (own, key) => (key === "prototype" ? own.prototype : (own[key] ??= anything())),
    apply: anything,
    construct: () => ({}),
  });
}

test("the server of the setting is started, started again and stopped", async () => {
  const happened = [];
  const commands = {};
  const editor = anything();
  Object.assign(editor, {
    version: "1.91.0",
    commands: { registerCommand: (name, run) => (commands[name] = run) },
    workspace: {
      getConfiguration: () => ({ get: () => "/opt/linkwright" }),
      onDidChangeConfiguration: () => ({}),
      createFileSystemWatcher: (pattern) => ({ pattern }),
    },
    window: { showErrorMessage: (text) => happened.push(text) },
  });
  const load = Module._load;
  Module._load = (name, ...rest) => (name === "vscode" ? editor : load(name, ...rest));
  // The library itself can be loaded; its client is replaced by one that only says what it is asked.
  const library = require("vscode-languageclient/node");
  assert.strictEqual(typeof library.LanguageClient, "function");
  let fails = false;
  class LanguageClient {
    constructor(id, name, server, { documentSelector, synchronize }) {
      const languages = documentSelector.map((it) => it.language);
      const { pattern } = synchronize.fileEvents;
      happened.push([server.command, ...server.args, ...languages, pattern]);
    }
    start() {
      return fails ? Promise.reject(new Error("not there")) : Promise.resolve();
    }
    stop() {
      happened.push("stopped");
      return Promise.resolve();
    }
  }
  Module._load = (name, ...rest) => {
    const other = { vscode: editor, "vscode-languageclient/node": { LanguageClient } };
    return other[name] ?? load(name, ...rest);
  };
  const extension = require("../extension.js");
  const started = ["/opt/linkwright", "lsp", "mech", "mech", "**/*.{csv,tsv,txt,dat}"];
  const context = { subscriptions: [] };
  await extension.activate(context);
  assert.strictEqual(context.subscriptions.length, 3);
  await commands["linkwright.restart"]();
  await extension.deactivate();
  await extension.deactivate();
  assert.deepStrictEqual(happened, [started, "stopped", started, "stopped"]);
  fails = true;
  await extension.activate(context);
  assert.match(happened.at(-1), /`\/opt\/linkwright lsp` does not start: not there/);
  Module._load = load;
});
