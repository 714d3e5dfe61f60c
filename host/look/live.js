// The page of "wrinkle watch": follows what the server shows, and sends switches and numbers.
const wait = ms => new Promise(done => setTimeout(done, ms));

function say(text, bad) {
    $("status").textContent = text;
    $("status").classList.toggle("bad", Boolean(bad));
}

async function post(path, body) {
    try {
        const reply = await fetch(path, {method: "POST", body: JSON.stringify(body)});
        if (!reply.ok) say(await reply.text(), true);
        return reply.ok;
    } catch {
        return false;  // follow() says that nobody answers
    }
}

// One request at a time: while a slider moves, only the latest values go.
function sender(path) {
    let next = null, busy = false;
    return async body => {
        next = body;
        if (busy) return;
        busy = true;
        while (next) {
            const now = next;
            next = null;
            await post(path, now);
        }
        busy = false;
    };
}

async function follow() {
    for (;;) {
        try {
            const reply = await fetch("/state?after=" + data.version);
            if (!reply.ok) throw new Error(await reply.text());
            const now = await reply.json();
            if (now.version !== data.version) {
                data = now;
                say("");
                showAll();
                showNumbers();
            } else if ($("status").classList.contains("bad")) say(data.status);
        } catch {
            say("wrinkle watch does not answer: has it ended?", true);
            await wait(500);
        }
    }
}

// --- Layers ---------------------------------------------------------------------------------------------------------
const sendLayers = sender("/layers");
const switchable = () => data.layers.filter(l => !l.resolve).map(l => l.name);

live.layer = (row, label, i) => {
    const name = data.layers[i].name, off = new Set(data.off);
    const others = switchable().filter(n => n !== name);
    const alone = !off.has(name) && others.length > 0 && others.every(n => off.has(n));
    const box = make("input", {type: "checkbox", checked: !off.has(name), id: "layer-" + i});
    box.onchange = () => {
        box.checked ? off.delete(name) : off.add(name);
        sendLayers({off: [...off]});
    };
    label.htmlFor = box.id;
    const button = make("button", {id: "alone " + i, textContent: "alone", title: alone ? "all layers again" : "switch all others off"});
    button.setAttribute("aria-pressed", alone);
    button.onclick = () => sendLayers({off: alone ? [] : others});
    row.prepend(box);
    row.append(button);
};

live.chosen = id => post("/condition", {on: id === "condition"});

// --- Numbers --------------------------------------------------------------------------------------------------------
const sendNumbers = sender("/numbers");
let rows = new Map();

function range(number) {
    const v = number.saved;
    if (number.whole) return [0, Math.max(2 * v, v + 8)];
    return v === 0 ? [-1, 1] : v > 0 ? [0, 2 * v] : [2 * v, 0];
}

function numberRow(number) {
    const [low, high] = range(number), step = number.whole ? 1 : "any";
    const label = `${number.group}: ${number.name}`;
    const slider = make("input", {type: "range", min: low, max: high, step, ariaLabel: label});
    const box = make("input", {type: "number", step, ariaLabel: label + ", exactly"});
    const row = make("div", {className: "number", title: `line ${number.line}`}, make("span", {textContent: number.name}), slider, box);
    row.dataset.id = number.id;
    const turn = value => {
        if (!Number.isFinite(value)) return;
        show(value);
        changes[number.id] = value;
        sendNumbers({...changes});
    };
    const show = value => {
        if (value > +slider.max) slider.max = value;
        if (value < +slider.min) slider.min = value;
        slider.value = value;
        if (document.activeElement !== box) box.value = value;
    };
    slider.oninput = () => turn(number.whole ? +slider.value : Number((+slider.value).toPrecision(4)));
    box.onchange = () => turn(box.value === "" ? NaN : +box.value);
    show(number.value);
    rows.set(number.id, {row, show, slider, box});
    return row;
}

let changes = {};

function showNumbers() {
    const ids = data.numbers.map(n => n.id).join(" ");
    $("numbers").hidden = data.numbers.length === 0;
    if (!data.unsaved) changes = {};
    if ($("numbers").dataset.ids !== ids || (!data.unsaved && $("numbers").dataset.unsaved === "true")) {
        const groups = new Map();
        rows = new Map();
        for (const number of data.numbers) groups.set(number.group, [...groups.get(number.group) || [], numberRow(number)]);
        const write = make("button", {id: "write", textContent: "Write into the file", title: "comments and order stay"});
        write.onclick = () => post("/write", {});
        const reset = make("button", {id: "reset", textContent: "Back to the file's"});
        reset.onclick = () => sendNumbers(Object.fromEntries(data.numbers.map(n => [n.id, n.saved])));
        $("numbers").lastChild.replaceChildren(make("p", {}, write, " ", reset), ...[...groups].map(([group, list]) =>
            make("fieldset", {}, make("legend", {textContent: group}), ...list)));
        $("numbers").dataset.ids = ids;
    }
    $("numbers").dataset.unsaved = data.unsaved;
    let changed = false;
    for (const number of data.numbers) {
        const {row, show, slider} = rows.get(number.id);
        row.classList.toggle("changed", number.value !== number.saved);
        changed = changed || number.value !== number.saved;
        if (document.activeElement !== slider) show(number.value);
    }
    $("write").disabled = $("reset").disabled = !changed;
}

// --- The pixel under the mouse --------------------------------------------------------------------------------------
let wanted = null, asking = false;
live.pixel = async pixel => {
    wanted = pixel;
    if (asking) return;
    asking = true;
    while (wanted) {
        const [x, y] = wanted;
        wanted = null;
        try {
            const reply = await fetch(`/pixel?x=${x}&y=${y}`);
            if (reply.ok) {
                $("pixel").hidden = false;
                $("pixel").lastChild.replaceChildren(...tableOf("", await reply.json()).lastChild.children);
            }
        } catch {
            break;  // follow() says that nobody answers
        }
    }
    asking = false;
};

showLayers();
showNumbers();
follow();
