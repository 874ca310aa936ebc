// Requests to the server and the messages that answer them.

let session = "";
let count = 0;

async function asked(path, options = {}) {
  const response = await fetch(path, { credentials: "same-origin", ...options });
  if (response.ok) return response;
  let words = await response.text();
  try {
    words = JSON.parse(words).message;
  } catch {
    // An error in plain text.
  }
  throw new Error(words.trim() || `The server answered with ${response.status}.`);
}

// A reloaded tab gets its earlier session with its files, if this is still open.
export async function begin(before = "") {
  const given = await (await asked(`/session?again=${before}`, { method: "POST" })).json();
  session = given.session;
  // The server ends a session without requests for a long time: its browser may have been killed.
  setInterval(() => asked(`/alive?session=${session}`, { method: "POST" }).catch(() => {}), 30000);
  addEventListener("pagehide", (event) => {
    if (!event.persisted) navigator.sendBeacon(`/end?session=${session}`);
  });
  return given;
}

export async function upload(file) {
  const path = `/file?session=${session}&name=${encodeURIComponent(file.name)}`;
  return (await asked(path, { method: "PUT", body: file })).json();
}

// Send a request; every message is passed to `heard(header, data)` as it comes, and the last one is returned.
export function request(queue, job, recipe, more, heard) {
  // The key is unique across reloads: the session may still hold a late stop of an earlier request.
  const key = `${performance.timeOrigin}-${++count}`;
  const body = JSON.stringify({ queue, job, recipe, more, key });
  const stop = () => asked(`/stop?session=${session}&queue=${queue}&key=${key}`, { method: "POST" });
  return { stop, ended: listen(body, heard) };
}

async function listen(body, heard) {
  const headers = { "Content-Type": "application/json" };
  const response = await asked(`/request?session=${session}`, { method: "POST", headers, body });
  const reader = response.body.getReader();
  let parts = [];
  let held = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) throw new Error("The server has ended: start roughcontact serve again.");
    parts.push(value);
    held += value.length;
    // Join the parts only when the message may be complete: maps come in many parts.
    while (held >= 8) {
      const start = parts[0].length >= 8 ? parts[0] : joined(parts, held);
      if (start !== parts[0]) parts = [start];
      const view = new DataView(start.buffer, start.byteOffset, 8);
      const [words, data] = [view.getUint32(0, true), view.getUint32(4, true)];
      if (held < 8 + words + data) break;
      const whole = parts.length === 1 ? parts[0] : joined(parts, held);
      const header = JSON.parse(new TextDecoder().decode(whole.subarray(8, 8 + words)));
      const bytes = whole.slice(8 + words, 8 + words + data);
      held -= 8 + words + data;
      parts = held > 0 ? [whole.subarray(8 + words + data)] : [];
      if (header.type === "end") {
        reader.cancel();
        return header;
      }
      heard(header, bytes.buffer);
    }
  }
}

function joined(parts, size) {
  const whole = new Uint8Array(size);
  let at = 0;
  for (const part of parts) {
    whole.set(part, at);
    at += part.length;
  }
  return whole;
}
