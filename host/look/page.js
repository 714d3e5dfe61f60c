"use strict";
// Of a report all data are in the page; of a live page the server sends them again whenever they change (live.js).
const $ = id => document.getElementById(id);
const make = (tag, properties = {}, ...children) => {
    const element = Object.assign(document.createElement(tag), properties);
    element.append(...children);
    return element;
};
let data = JSON.parse($("data").textContent);
let view = "", shown = {};
const live = {layer: null, pixel: null, chosen: null};  // what a live page does besides
const place = {split: 0.5, scale: 1, x: 0, y: 0, fitted: true};

// --- The picture ----------------------------------------------------------------------------------------------------
const viewNow = () => data.views.find(v => v.id === view) || data.views[0];

// A picture replaces the last one when it is there, so that nothing flickers; the latest wins.
function load(image, url) {
    if (url && shown[image.id] === url && image.src) return Promise.resolve();
    shown[image.id] = url;
    if (!url) return Promise.resolve(image.removeAttribute("src"));
    const next = new Image();
    next.src = url;
    return next.decode().then(() => { if (shown[image.id] === url) image.src = url; }, () => {});
}

function showView() {
    const now = viewNow();
    for (const hidden of [$("handle"), $("split-label"), $("before")]) hidden.style.display = now && now.before ? "" : "none";
    if (!now) return;
    view = now.id;
    const version = data.version;
    Promise.all([load($("after"), now.after), load($("before"), now.before)]).then(() => { document.body.dataset.shown = version; });
    $("tag-before").textContent = now.before ? now.before_title || "before" : "";
    $("tag-after").textContent = now.before ? now.after_title || "after" : now.title;
    $("note").replaceChildren(...(now.id === "marked" ? data.marked.flatMap(m =>
        [make("i", {style: `background: ${m.color}`}), m.meaning]) : [now.note || ""]));
    for (const button of document.querySelectorAll("[data-view]")) button.setAttribute("aria-pressed", button.dataset.view === view);
    draw();
}

function choose(id) {
    view = id;
    showView();
    if (live.chosen) live.chosen(id);
}

function fit() {
    const stage = $("stage"), [width, height] = data.size || [1, 1];
    place.scale = Math.min(stage.clientWidth / width, stage.clientHeight / height);
    place.x = (stage.clientWidth - width * place.scale) / 2;
    place.y = (stage.clientHeight - height * place.scale) / 2;
    place.fitted = true;
}

function draw() {
    if (!data.size) return;
    if (place.fitted) fit();
    const [width, height] = data.size, pictures = $("pictures");
    Object.assign(pictures.style, {width: width + "px", height: height + "px",
                                   transform: `translate(${place.x}px, ${place.y}px) scale(${place.scale})`});
    pictures.classList.toggle("pixels", place.scale > 1.5);
    $("before").style.clipPath = `inset(0 ${(1 - place.split) * 100}% 0 0)`;
    $("handle").style.left = place.x + place.split * width * place.scale + "px";
    $("split").value = place.split;
    $("zoom").value = Math.round(place.scale * 100) + " %";
}

function zoom(factor, x = $("stage").clientWidth / 2, y = $("stage").clientHeight / 2) {
    const scale = Math.min(Math.max(place.scale * factor, 0.05), 64);
    place.x = x - (x - place.x) * scale / place.scale;
    place.y = y - (y - place.y) * scale / place.scale;
    place.scale = scale;
    place.fitted = false;
    draw();
}

function setSplit(share) {
    place.split = Math.min(Math.max(share, 0), 1);
    draw();
}

/// The pixel under a place on the screen; null outside of the picture.
function pixelAt(event) {
    const box = $("stage").getBoundingClientRect();
    const x = Math.floor((event.clientX - box.left - place.x) / place.scale), y = Math.floor((event.clientY - box.top - place.y) / place.scale);
    return data.size && x >= 0 && y >= 0 && x < data.size[0] && y < data.size[1] ? [x, y] : null;
}

function listen() {
    const stage = $("stage");
    let drag = null;
    stage.addEventListener("pointerdown", event => {
        drag = {slider: event.target === $("handle"), x: event.clientX - place.x, y: event.clientY - place.y};
        stage.setPointerCapture(event.pointerId);
    });
    stage.addEventListener("pointermove", event => {
        const pixel = pixelAt(event);
        $("where").value = pixel ? `pixel ${pixel[0]}, ${pixel[1]}` : "";
        if (!drag) return pixel && live.pixel ? live.pixel(pixel) : undefined;
        if (drag.slider) return setSplit((event.clientX - stage.getBoundingClientRect().left - place.x) / (data.size[0] * place.scale));
        Object.assign(place, {x: event.clientX - drag.x, y: event.clientY - drag.y, fitted: false});
        draw();
    });
    for (const end of ["pointerup", "pointercancel"]) stage.addEventListener(end, () => { drag = null; });
    stage.addEventListener("wheel", event => {
        const box = stage.getBoundingClientRect();
        event.preventDefault();
        zoom(Math.exp(-event.deltaY / 400), event.clientX - box.left, event.clientY - box.top);
    }, {passive: false});
    const keys = {"+": () => zoom(1.5), "=": () => zoom(1.5), "-": () => zoom(1 / 1.5), "0": () => { fit(); draw(); },
                  "1": () => zoom(1 / place.scale / devicePixelRatio), ArrowLeft: () => setSplit(place.split - 0.02),
                  ArrowRight: () => setSplit(place.split + 0.02)};
    stage.addEventListener("keydown", event => {
        if (!keys[event.key]) return;
        event.preventDefault();
        keys[event.key]();
    });
    for (const [id, key] of [["in", "+"], ["out", "-"], ["fit", "0"], ["one", "1"]]) $(id).onclick = keys[key];
    $("split").oninput = event => setSplit(+event.target.value);
    addEventListener("resize", draw);
}

// --- What is beside it ----------------------------------------------------------------------------------------------
function viewButton(id, text) {
    const button = make("button", {id: "view " + id, textContent: text, onclick: () => choose(id)});
    button.dataset.view = id;
    return button;
}

function showLayers() {
    $("layers").hidden = data.layers.length === 0;
    $("layers").lastChild.replaceChildren(...data.layers.map((layer, i) => {
        if (layer.resolve) return make("div", {className: "stage", textContent: "resolve: on the surface so far"});
        const name = make("label", {title: layer.name}, layer.name, " ", make("small", {textContent: layer.kind}));
        const row = make("div", {className: "layer"}, name);
        if (live.layer) live.layer(row, name, i);
        else if (data.views.some(v => v.id === "layer " + i)) row.append(viewButton("layer " + i, "alone"));
        return row;
    }));
}

function showProblems() {
    const lines = data.source.split("\n");
    const excerpt = problem => {
        if (!problem.line) return make("div", {className: "said", textContent: problem.text});
        const box = make("div");
        for (let n = Math.max(problem.line - 2, 1); n <= Math.min(problem.line + 1, lines.length); ++n) {
            box.append(make("div", {className: n === problem.line ? "at" : "dim", textContent: `${String(n).padStart(4)}  ${lines[n - 1]}`}));
            if (n === problem.line) box.append(make("div", {className: "said", textContent: problem.text}));
        }
        return box;
    };
    $("problems").hidden = data.problems.length === 0;
    $("problems").replaceChildren(make("h2", {textContent: data.size ? "Not evaluated: the picture is the last good one" : "Not evaluated"}),
                                  make("pre", {className: "lines"}, ...data.problems.map(excerpt)));
    $("warnings").hidden = data.warnings.length === 0;
    $("warnings").replaceChildren(make("h2", {textContent: "Warnings"}), ...data.warnings.map(text => make("div", {textContent: text})));
}

function tableOf(title, rows) {
    return make("section", {}, make("h2", {textContent: title}), make("table", {}, make("tbody", {}, ...rows.map(([name, value]) =>
        make("tr", {}, make("td", {textContent: name}), make("td", {textContent: value}))))));
}

function showAll() {
    const focus = document.activeElement.id;  // of the keyboard: elements are made anew
    document.title = data.title + " - wrinkle";
    $("title").textContent = data.title;
    $("status").textContent = data.status;
    $("views").replaceChildren(...data.views.filter(v => !v.id.startsWith("layer ")).map(v => viewButton(v.id, v.title)));
    showProblems();
    showLayers();
    $("tables").replaceChildren(...data.tables.map(t => tableOf(t.title, t.rows)));
    $("source").hidden = !data.source;
    $("source").lastChild.textContent = data.source;
    showView();
    if (focus && $(focus)) $(focus).focus();
}

listen();
showAll();
