// SPDX-License-Identifier: Apache-2.0

/** Address of the server, from that of the page: the same host, unless ?server=HOST:PORT names another. */
export function serverAddress(page: string, token: string): string {
  const location = new URL(page);
  const named = location.searchParams.get("server");
  const isSecure = location.protocol === "https:" || named?.startsWith("wss://");
  const host = named ? named.replace(/^\w+:\/\//, "").replace(/\/.*$/, "") : location.host;
  const address = new URL(`${isSecure ? "wss" : "ws"}://${host}/`);
  if (token !== "") address.searchParams.set("token", token);
  return address.href;
}

/** Whether the server is on this machine. */
export function isOfThisMachine(address: string): boolean {
  return ["localhost", "127.0.0.1", "[::1]"].includes(new URL(address).hostname);
}

/** For people: without the token. */
export function shownAddress(address: string): string {
  const { protocol, host } = new URL(address);
  return `${protocol}//${host}`;
}
