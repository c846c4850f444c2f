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

/// The numbers of keys that do something in the browser itself.
const NUMBERS: [(&str, u32); 6] =
    [("Tab", 9), ("Enter", 13), ("ArrowLeft", 37), ("ArrowUp", 38), ("ArrowRight", 39), ("ArrowDown", 40)];

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
        let text = match key {
            "Enter" => "\r",
            key if key.len() == 1 => key,
            _ => "",
        };
        for kind in ["keyDown", "keyUp"] {
            let text = if kind == "keyDown" { text } else { "" };
            let number = NUMBERS.iter().find(|(name, _)| *name == key).map_or(0, |(_, number)| *number);
            let event = json!({"type": kind, "key": key, "code": code, "text": text, "windowsVirtualKeyCode": number});
            self.call("Input.dispatchKeyEvent", &event);
        }
    }

    /// A place in the window, given in parts of the element that a selector finds, which is scrolled into sight.
    fn place(&mut self, selector: &str, [x, y]: [f64; 2]) -> [f64; 2] {
        let found = self.eval(&format!(
            "(() => {{ const e = document.querySelector('{selector}'); e.scrollIntoView({{block: 'center'}}); \
             const b = e.getBoundingClientRect(); return [b.x + {x} * b.width, b.y + {y} * b.height]; }})()"
        ));
        [0, 1].map(|axis| found[axis].as_f64().unwrap())
    }

    /// Drags with a button of the mouse, `left` or `right`, from one point to another, in parts of the element that a
    /// selector finds.
    pub(super) fn drag(&mut self, button: &str, selector: &str, from: [f64; 2], to: [f64; 2]) {
        let half = [0, 1].map(|i| 0.5 * (from[i] + to[i]));
        let held = if button == "right" { 2 } else { 1 };
        for (kind, at, button, buttons) in [
            ("mouseMoved", from, "none", 0),
            ("mousePressed", from, button, held),
            ("mouseMoved", half, button, held),
            ("mouseMoved", to, button, held),
            ("mouseReleased", to, button, 0),
        ] {
            let [x, y] = self.place(selector, at);
            let event =
                json!({"type": kind, "x": x, "y": y, "button": button, "buttons": buttons, "clickCount": 1});
            self.call("Input.dispatchMouseEvent", &event);
        }
    }

    /// Turns the wheel over the middle of the element that a selector finds.
    pub(super) fn wheel(&mut self, selector: &str, delta: f64) {
        let [x, y] = self.place(selector, [0.5, 0.5]);
        let event = json!({"type": "mouseWheel", "x": x, "y": y, "deltaX": 0, "deltaY": delta});
        self.call("Input.dispatchMouseEvent", &event);
    }

    /// Moves fingers over the element that a selector finds, each from one place to another in parts of the element.
    pub(super) fn touch(&mut self, selector: &str, fingers: &[[[f64; 2]; 2]]) {
        self.call("Emulation.setTouchEmulationEnabled", &json!({"enabled": true, "maxTouchPoints": 5}));
        for (kind, part) in [("touchStart", 0.0), ("touchMove", 0.5), ("touchMove", 1.0)] {
            let mut points = Vec::new();
            for (id, [from, to]) in fingers.iter().enumerate() {
                let [x, y] = self.place(selector, [0, 1].map(|i| from[i] + part * (to[i] - from[i])));
                points.push(json!({"x": x, "y": y, "id": id}));
            }
            self.call("Input.dispatchTouchEvent", &json!({"type": kind, "touchPoints": points}));
        }
        self.call("Input.dispatchTouchEvent", &json!({"type": "touchEnd", "touchPoints": []}));
    }

    /// Clicks in the middle of the element with an id.
    pub(super) fn click(&mut self, id: &str) {
        self.drag("left", &format!("#{id}"), [0.5, 0.5], [0.5, 0.5]);
    }
}

impl Drop for DevTools {
    fn drop(&mut self) {
        let _ = self.browser.kill();
        let _ = self.browser.wait();
    }
}
