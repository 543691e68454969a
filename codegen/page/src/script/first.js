// The page of a file: its data is in it. A script before this one may leave a provider.

const root = document.querySelector("[data-page]");
const page = mount(root, JSON.parse(document.getElementById("data").textContent), globalThis.linkwright?.provider ?? null);
globalThis.linkwright = { ...globalThis.linkwright, mount, page };
document.body.dataset.ready = "";
