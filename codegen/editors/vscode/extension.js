// Starts `linkwright lsp` for descriptions, and again where it is asked to or its path is another.

"use strict";

const { commands, window, workspace } = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

let client;
// Tables that change beside a description.
let tables;

function start() {
  const command = workspace.getConfiguration("linkwright").get("path") || "linkwright";
  const server = { command, args: ["lsp"] };
  // What is not saved is a description, too.
  const documentSelector = [
    { scheme: "file", language: "mech" },
    { scheme: "untitled", language: "mech" },
  ];
  const options = { documentSelector, synchronize: { fileEvents: tables } };
  client = new LanguageClient("linkwright", "Linkwright", server, options);
  return client.start().catch((error) => {
    window.showErrorMessage(
      `\`${command} lsp\` does not start: ${error.message}. ` +
        "Install it with `cargo install --path codegen/cli` or set `linkwright.path`.",
    );
  });
}

async function stop() {
  const running = client;
  client = undefined;
  if (running !== undefined) {
    // A client that never started cannot be stopped.
    await running.stop().catch(() => {});
  }
}

async function restart() {
  await stop();
  await start();
}

exports.activate = (context) => {
  tables = workspace.createFileSystemWatcher("**/*.{csv,tsv,txt,dat}");
  context.subscriptions.push(
    tables,
    commands.registerCommand("linkwright.restart", restart),
    workspace.onDidChangeConfiguration((event) =>
      event.affectsConfiguration("linkwright.path") ? restart() : undefined,
    ),
  );
  return start();
};

exports.deactivate = stop;
