import { render } from "preact";
import "uplot/dist/uPlot.min.css";
import "./app.css";
import { App } from "./app.tsx";
import { Session } from "./session.ts";

const scheme = location.protocol === "https:" ? "wss" : "ws";
const session = new Session(`${scheme}://${location.host}/ws`);
const host = document.getElementById("app");
if (!host) throw new Error("index.html has no element with the id app");
render(<App session={session} />, host);
session.open();
