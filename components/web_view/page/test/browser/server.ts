// SPDX-License-Identifier: Apache-2.0
/** A web view of panvo in a process of its own, without DDS, that serves the page. */
import { spawn, type ChildProcess } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";

export interface Options {
  port?: number; // 0: any
  token?: string;
  map?: string; // a file in the server's folder, kept by a landmark_store
}

export class Server {
  port = 0;
  #process: ChildProcess | undefined;
  readonly folder = fs.mkdtempSync(path.join(os.tmpdir(), "page_test_"));

  async start({ port = 0, token = "", map }: Options = {}): Promise<void> {
    const parameters: [string, unknown][] = [["port", port], ["token", token], ["allow_control", true], ["page", path.resolve("dist")]];
    const lines = parameters.map(([name, value]) => `      - {name: ${name}, value: ${JSON.stringify(value)}}`);
    const encoder = ["    - pkg: panvo_compressed_images", "      plugin: ImageEncoderComponent", "      name: encoder"]; // has parameters that can be set
    const file = ["      param:", `      - {name: file, value: ${JSON.stringify(path.join(this.folder, map ?? ""))}}`];
    const store = ["    - pkg: panvo_landmarks", "      plugin: LandmarkStoreComponent", "      name: landmark_store", ...file];
    const system = path.join(this.folder, "view.yaml");
    const head = ["launch:", "- node_container:", "    pkg: panvo_runner", "    exec: panvo_run", "    name: viewing", '    namespace: ""', "    composable_node:"];
    fs.writeFileSync(system, [...head, "    - pkg: panvo_web_view", "      plugin: WebViewComponent", "      name: web_view", "      param:", ...lines, ...encoder, ...(map ? store : []), ""].join("\n"));
    this.#process = spawn(process.env.PANVO_RUN!, ["--local", system], { stdio: ["ignore", "pipe", "pipe"] });
    this.port = await portOf(this.#process);
  }

  async stop(): Promise<void> {
    const ended = new Promise((resolve) => this.#process?.once("exit", resolve));
    if (!this.#process?.kill("SIGINT")) return;
    await ended;
    this.#process = undefined;
  }

  async remove(): Promise<void> {
    await this.stop();
    fs.rmSync(this.folder, { recursive: true });
  }

  url(token = ""): string {
    return `http://127.0.0.1:${this.port}/${token && `?token=${token}`}`;
  }
}

/** From the log: "listening on ws://127.0.0.1:40001". */
function portOf(child: ChildProcess): Promise<number> {
  return new Promise((resolve, reject) => {
    let log = "";
    const read = (text: Buffer) => {
      log += text.toString();
      const found = /listening on ws:\/\/[\d.]+:(\d+)/.exec(log);
      if (found) resolve(Number(found[1]));
    };
    child.stdout!.on("data", read);
    child.stderr!.on("data", read);
    child.once("exit", () => reject(new Error(`the server ended: ${log}`)));
  });
}
