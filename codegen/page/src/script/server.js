// The server of the description answers the questions of its page.

globalThis.linkwright = {
  provider: {
    ask: async (question) => {
      const response = await fetch("/ask", { method: "POST", body: JSON.stringify(question) });
      if (!response.ok) throw new Error(await response.text());
      return response.json();
    },
  },
};
