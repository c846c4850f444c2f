//! A page in a real browser, driven through the DevTools protocol over pipes.

use std::fs::File;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

/// How long anything may take.
const PATIENCE: Duration = Duration::from_secs(120);

/// A page in a browser of its own.
pub(super) struct DevTools {
    browser: Child,
    orders: File,
    answers: Receiver<Value>,
    last: u64,
    session: Option<String>,
    /// What the page and its worker wrote to the console, and errors that nobody caught.
    pub(super) console: Vec<String>,
    _folder: tempfile::TempDir,
}

impl DevTools {
    /// Starts the browser `program` with an empty page of `width` pixels in a light or a dark theme.
    pub(super) fn start(program: &Path, width: u32, dark: bool) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let pipe = |name: &str| folder.path().join(name);
        let made = Command::new("mkfifo").args([pipe("orders"), pipe("answers")]).status().unwrap();
        assert!(made.success());
        // The browser reads orders from file 3 and writes answers to file 4.
        let browser = Command::new("bash")
            .args(["-c", r#"exec "$0" "${@:3}" 3<"$1" 4>"$2""#])
            .arg(program)
            .args([pipe("orders"), pipe("answers")])
            .args([
                "--headless",
                "--no-sandbox",
                "--disable-gpu",
                "--no-first-run",
                "--remote-debugging-pipe",
            ])
            .args(["--disable-background-networking", "--disable-component-update", "--disable-sync"])
            .arg(format!("--user-data-dir={}", pipe("profile").display()))
            .arg("about:blank")
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let orders = File::options().write(true).open(pipe("orders")).unwrap();
        let from = BufReader::new(File::open(pipe("answers")).unwrap());
        let (sender, answers) = channel();
        std::thread::spawn(move || {
            for message in from.split(0).map_while(Result::ok) {
                let Ok(value) = serde_json::from_slice(&message) else { return };
                if sender.send(value).is_err() {
                    return;
                }
            }
        });
        let console = Vec::new();
        let mut page = Self { browser, orders, answers, last: 0, session: None, console, _folder: folder };
        page.attach(width, dark);
        page
    }

    fn attach(&mut self, width: u32, dark: bool) {
        let target = self.call("Target.createTarget", &json!({"url": "about:blank"}))["targetId"].clone();
        let attached = self.call("Target.attachToTarget", &json!({"targetId": target, "flatten": true}));
        self.session = attached["sessionId"].as_str().map(str::to_owned);
        for domain in ["Page", "Runtime", "Log"] {
            self.call(&format!("{domain}.enable"), &json!({}));
        }
        let mobile = width < 500;
        let size = json!({"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": mobile});
        self.call("Emulation.setDeviceMetricsOverride", &size);
        let theme = if dark { "dark" } else { "light" };
        let media = json!({"features": [{"name": "prefers-color-scheme", "value": theme}]});
        self.call("Emulation.setEmulatedMedia", &media);
    }

    /// Gives an order and waits for its answer.
    pub(super) fn call(&mut self, method: &str, parameters: &Value) -> Value {
        self.last += 1;
        let mut order = json!({"id": self.last, "method": method, "params": parameters});
        if let Some(session) = &self.session {
            order["sessionId"] = json!(session);
        }
        self.orders.write_all(order.to_string().as_bytes()).unwrap();
        self.orders.write_all(&[0]).unwrap();
        loop {
            let message = self.answers.recv_timeout(PATIENCE).unwrap_or_else(|e| panic!("{method}: {e}"));
            if message["id"] == self.last {
                assert!(message["error"].is_null(), "{method}: {message}");
                return message["result"].clone();
            }
            let event = message["method"].as_str().unwrap_or_default();
            if ["Runtime.consoleAPICalled", "Runtime.exceptionThrown", "Log.entryAdded"].contains(&event) {
                self.console.push(message["params"].to_string());
            }
        }
    }

    /// Opens an address and waits until its scripts have run.
    pub(super) fn open(&mut self, url: &str) {
        self.call("Page.navigate", &json!({"url": url}));
        self.wait("document.readyState === 'complete' && location.href !== 'about:blank'");
    }

    /// The value of an expression, or of what it promises.
    pub(super) fn eval(&mut self, expression: &str) -> Value {
        let parameters = json!({"expression": expression, "awaitPromise": true, "returnByValue": true});
        let answer = self.call("Runtime.evaluate", &parameters);
        assert!(answer["exceptionDetails"].is_null(), "{expression}: {}", answer["exceptionDetails"]);
        answer["result"]["value"].clone()
    }

    /// Waits until an expression is true.
    pub(super) fn wait(&mut self, expression: &str) {
        let started = Instant::now();
        while self.eval(&format!("Boolean({expression})")) != true {
            let texts = "['status', 'frame', 'errors'].map((id) => document.getElementById(id)?.textContent).join(' | ')";
            assert!(started.elapsed() < PATIENCE, "never {expression}: {}", self.eval(texts));
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    /// The text of the element with an id.
    pub(super) fn text(&mut self, id: &str) -> String {
        let text = self.eval(&format!("document.getElementById('{id}').textContent"));
        text.as_str().unwrap_or_default().to_owned()
    }

    /// Presses a key.
    pub(super) fn key(&mut self, key: &str, code: &str) {
        let text = if key.len() == 1 { key } else { "" };
        for kind in ["keyDown", "keyUp"] {
            let text = if kind == "keyDown" { text } else { "" };
            let event = json!({"type": kind, "key": key, "code": code, "text": text});
            self.call("Input.dispatchKeyEvent", &event);
        }
    }

    /// Drags with the left button from one point to another, in parts of the element that a selector finds.
    pub(super) fn drag(&mut self, selector: &str, from: [f64; 2], to: [f64; 2]) {
        let place = format!(
            "(() => {{ const e = document.querySelector('{selector}'); e.scrollIntoView({{block: 'center'}}); \
             const b = e.getBoundingClientRect(); return [b.x, b.y, b.width, b.height]; }})()"
        );
        let found = self.eval(&place);
        let number = |i: usize| found[i].as_f64().unwrap();
        let at = |[x, y]: [f64; 2]| [number(0) + x * number(2), number(1) + y * number(3)];
        let half = [0, 1].map(|i| 0.5 * (from[i] + to[i]));
        for (kind, [x, y], buttons) in [
            ("mouseMoved", at(from), 0),
            ("mousePressed", at(from), 1),
            ("mouseMoved", at(half), 1),
            ("mouseMoved", at(to), 1),
            ("mouseReleased", at(to), 0),
        ] {
            let button = if kind == "mouseMoved" && buttons == 0 { "none" } else { "left" };
            let event =
                json!({"type": kind, "x": x, "y": y, "button": button, "buttons": buttons, "clickCount": 1});
            self.call("Input.dispatchMouseEvent", &event);
        }
    }

    /// Clicks in the middle of the element with an id.
    pub(super) fn click(&mut self, id: &str) {
        self.drag(&format!("#{id}"), [0.5, 0.5], [0.5, 0.5]);
    }
}

impl Drop for DevTools {
    fn drop(&mut self) {
        let _ = self.browser.kill();
        let _ = self.browser.wait();
    }
}
