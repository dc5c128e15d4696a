"""The matrix of a score as one page of HTML, without scripts and without a network.

Products stand in columns, flags and groups in rows; a cell says its misses in words and signs
beside its colour. Below stand the misses of each product, each with its sentence. The same results
give the same bytes. `vectors.py score --out FILE.html` writes it.
"""
import collections

import vectors

HEAD = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'">
<title>Assay vectors: who misses what</title>
<style>
:root { color-scheme: light dark; --ground: #fdfdfc; --text: #1f2328; --quiet: #5b626b;
  --line: #d8dadd; --good: #1a7f37; --bad: #b3261e; --open: #8a5a00; --good-ground: #e9f5ec;
  --bad-ground: #fbe6e4; --open-ground: #faf0da; }
@media (prefers-color-scheme: dark) {
  :root { --ground: #16191d; --text: #e4e6e9; --quiet: #a2a9b3; --line: #373d45; --good: #57c271;
    --bad: #ff8078; --open: #e3b04b; --good-ground: #17281c; --bad-ground: #3a1d1b;
    --open-ground: #33290f; }
}
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 80rem; padding: 1.5rem 1rem 3rem; background: var(--ground);
  color: var(--text); font: 15px/1.5 system-ui, "Segoe UI", "Liberation Sans", sans-serif; }
h1 { font-size: 1.5rem; margin: 0; }
h2 { font-size: 1.2rem; margin: 2.2rem 0 .6rem; padding-top: .8rem;
  border-top: 1px solid var(--line); }
h3 { font-size: 1rem; margin: 1.4rem 0 .3rem; }
p, ul { margin: .4rem 0; max-width: 56rem; }
code { font: .87em ui-monospace, "Liberation Mono", monospace; overflow-wrap: anywhere; }
small, .quiet { color: var(--quiet); font-size: .85rem; font-weight: normal; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th, td { border-bottom: 1px solid var(--line); padding: .35rem .5rem; text-align: right;
  vertical-align: top; }
th:first-child, td.words { text-align: left; }
thead th { vertical-align: bottom; }
.wide { overflow-x: auto; }
.matrix tbody th { min-width: 12rem; }
.matrix thead th:not(:first-child) { min-width: 4.2rem; max-width: 7rem; overflow-wrap: anywhere; }
.matrix small, .chip small { display: block; line-height: 1.3; }
.matrix td { white-space: nowrap; }
.matrix td b, .chip b { font-weight: 600; }
.bad { background: var(--bad-ground); } .bad b { color: var(--bad); }
.open { background: var(--open-ground); } .open b { color: var(--open); }
.good { background: var(--good-ground); } .good b { color: var(--good); }
.none { color: var(--quiet); }
.legend { display: flex; flex-wrap: wrap; gap: .5rem; padding: 0; list-style: none; }
.chip { padding: .25rem .6rem; border: 1px solid var(--line); border-radius: 6px; }
.cases { padding-left: 1.2rem; }
.cases li { margin: .35rem 0; }
@media (max-width: 640px), print {
  thead { display: none; }
  tbody, tr, tbody th { display: block; }
  tr { display: grid; grid-template-columns: repeat(auto-fill, minmax(6.2rem, 1fr)); gap: .25rem;
    padding: .5rem 0; border-bottom: 1px solid var(--line); }
  th, td { border: 0; text-align: left; }
  tbody th, td.words { grid-column: 1 / -1; padding: 0; }
  td[data-of]::before { content: attr(data-of) " "; color: var(--quiet); font-size: .85rem; }
}
@media print {
  body { max-width: none; font-size: 10pt; padding: 0; }
  tr, li, h3 { break-inside: avoid; }
  h2, h3 { break-after: avoid; }
  td, .chip { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
}
</style></head><body>
"""

LEGEND = """<ul class="legend">
<li class="chip bad"><b>&#x2717; 3/17</b> <small>3 of 17 cases missed</small></li>
<li class="chip open"><b>! 0/17</b> <small>none missed, but late times, alarms or answers missing</small></li>
<li class="chip good"><b>&#x2713; 0/17</b> <small>all right</small></li>
<li class="chip none">&ndash; <small>not asked, or not supported</small></li>
</ul>
"""

WORDS = """<p>A <b>miss</b> is the answer free where features meet, or a share of a step that is not
safe. It counts even if the product does not promise to find such contacts: some products test only
vertices against faces, or state that they miss contacts. <code>corpus/peers</code> states what its
products promise, and its FINDINGS.md what causes the defects. A <b>late</b> time is a first time
after the contact, even if only in the last digit. An <b>alarm</b> is a contact that does not exist.
<b>Unanswered</b> cases ended undecided, by an error, a crash, or no answer in time.
<b>Unsupported</b> cases were not asked, because the product's contract leaves them out. Where features
only touch, be it at the end of the step, both answers are right: a section below counts such answers.
<b>To run it again</b>: <code>vectors.py run --detector LIB.so</code> asks a product all cases, and
those of a row with the options that stand in the row; <code>vectors.py flags</code> says what each flag
means.</p>\n"""

TOUCHING = """<h2>Where features only touch</h2>
<p>For closed sets these cases are contacts; a product that counts only overlaps answers free. Both \
are right, and a product should hold to one of them.</p>\n<ul>\n"""

# What is counted of a product, and the words that stand before the ids.
LISTED = (("late", "Late times"), ("alarm", "Alarms"), ("crash", "Crashes"),
          ("timeout", "Timeouts"), ("error", "Errors"), ("undecided", "Undecided"))
COLUMNS = (("late", ("late",)), ("alarms", ("alarm",)),
           ("undecided, error", ("undecided", "error")),
           ("crash, timeout", ("crash", "timeout")), ("unsupported", ("unsupported",)))


def escaped(text):
    for sign, name in (("&", "amp"), ("<", "lt"), (">", "gt"), ('"', "quot")):
        text = text.replace(sign, f"&{name};")
    return text


def count_text(count, one, many):
    return f"{count} {one if count == 1 else many}"


def interval(time):
    lo, hi = map(vectors.decimal, time)
    return f" at t = {lo}" if lo == hi else f" between t = {lo} and {hi}"


def cell_html(outcomes, letter):
    """A cell of the outcomes that its cases have, and how many have each."""
    asked = sum(outcomes.values()) - outcomes["unsupported"]
    if not asked:
        return f'<td class="none" data-of="{letter}">&ndash;</td>'
    unanswered = sum(outcomes[o] for o in vectors.NO_ANSWERS)
    others = "<br>".join(
        ([f"{outcomes['late']} late"] if outcomes["late"] else []) +
        ([count_text(outcomes["alarm"], "alarm", "alarms")] if outcomes["alarm"] else []) +
        ([f"{unanswered} unanswered"] if unanswered else []))
    kind, sign = (("bad", "&#x2717;") if outcomes["miss"] else ("open", "!") if others
                  else ("good", "&#x2713;"))
    small = f"<small>{others}</small>" if others else ""
    return (f'<td class="{kind}" data-of="{letter}"><b>{sign} {outcomes["miss"]}/{asked}</b>'
            f"{small}</td>")


def matrix_html(title, members, every, reason):
    """A row a name, which has ids in `members`; `reason` says what stands below the name."""
    html = (f'<div class="wide"><table class="matrix">\n<thead><tr><th scope="col">{title}</th>' +
            "".join(f'<th scope="col">{vectors.letter_of(i)} '
                    f"<small>{escaped(judged.name())}</small></th>"
                    for i, judged in enumerate(every)) + "</tr></thead>\n<tbody>\n")
    for name, ids in members.items():
        counts = [collections.Counter(judged.outcome[i] for i in ids if i in judged.outcome)
                  for judged in every]
        if all(set(count) <= {"unsupported"} for count in counts):
            continue
        cells = "".join(cell_html(count, vectors.letter_of(i)) for i, count in enumerate(counts))
        html += f'<tr><th scope="row">{escaped(name)}{reason(name)}</th>{cells}</tr>\n'
    return html + "</tbody></table></div>\n"


def products_html(every):
    html = ('<div class="wide"><table>\n<thead><tr><th scope="col">product</th><th>cases asked</th>'
            "<th>misses</th>" + "".join(f"<th>{words}</th>" for words, _ in COLUMNS) +
            "</tr></thead>\n<tbody>\n")
    for i, judged in enumerate(every):
        misses = len(judged.ids("miss"))
        html += (f'<tr><th scope="row">{vectors.letter_of(i)} &nbsp;{escaped(judged.name())} '
                 f"<small>version {escaped(judged.product['version'])}</small></th>"
                 f'<td data-of="cases asked">'
                 f'{len(judged.outcome) - len(judged.ids("unsupported"))}</td>'
                 f'<td class="{"bad" if misses else "good"}" data-of="misses"><b>{misses}</b></td>' +
                 "".join(f'<td data-of="{words}">{len(judged.ids(*outcomes))}</td>'
                         for words, outcomes in COLUMNS) + "</tr>\n")
    return html + "</tbody></table></div>\n"


def touching_html(every):
    items = "".join(f"<li>{vectors.letter_of(i)} {escaped(judged.name())}: "
                    f"{judged.closed} called contact, {judged.open} free</li>\n"
                    for i, judged in enumerate(every) if judged.closed or judged.open)
    return f"{TOUCHING}{items}</ul>\n" if items else ""


def answer_text(answer):
    if answer["answer"] == "share":
        return f"share {vectors.decimal(answer['share'])}"
    return answer["answer"] + (interval(answer["time"]) if "time" in answer else "")


def case_html(case, judged):
    at, answer = judged.missed[case.id]
    time = case.steps[at].first_time
    step = f"step {at + 1}: " if len(case.steps) > 1 else ""
    return (f"<li><code>{escaped(case.id)}</code> {escaped(case.about)}<br><small>{step}contact"
            f"{interval(time) if time else ''}; answered {escaped(answer_text(answer))}. "
            f"{escaped(', '.join(case.flags))}</small></li>\n")


def product_html(judged, letter, cases):
    misses = judged.ids("miss")
    told = count_text(len(misses), "miss", "misses") if misses else "no miss"
    html = f"<h3>{letter} {escaped(judged.name_and_version())}: {told}</h3>\n"
    if misses:
        items = "".join(case_html(cases[i], judged) for i in misses)
        html += f'<ul class="cases">\n{items}</ul>\n'
    for outcome, words in LISTED:
        ids = judged.ids(outcome)
        if ids:
            codes = "".join(f" <code>{escaped(i)}</code>" for i in ids)
            html += f"<p>{words} ({len(ids)}):{codes}</p>\n"
    if judged.early:
        html += f"<p>Early, which is safe: the times of {judged.early} steps</p>\n"
    if judged.gave_pairs:
        html += (f"<p>Pairs of triangles: {judged.missing} in contact not named, {judged.spurious} "
                 "named without contact</p>\n")
    if judged.uses:
        html += f"<p>Limits: {vectors.uses_text(judged)}</p>\n"
    return html


def page(asked, every):
    """The page of products that were judged on a set."""
    info = asked.info
    flags, groups = asked.members()

    def again(name, words=""):
        return f"<br><small>{escaped(words)} <code>--group {escaped(name)}</code></small>"
    html = (f"{HEAD}<h1>Who misses what</h1>\n<p>{info['cases']:,} small hard cases of continuous "
            "collision detection, whose answers are known exactly. <span class=\"quiet\">Set "
            f"{escaped(info['version'])} ({escaped(info['profile'])}), digest <code>"
            f"{info['digest']}</code></span></p>\n" + WORDS + products_html(every) +
            "<h2>By what makes a case hard</h2>\n" + LEGEND +
            matrix_html("flag: what goes wrong", flags, every,
                        lambda flag: again(flag, info["flags"][flag]["wrong"])) +
            "<h2>By group</h2>\n" + matrix_html("group", groups, every, again) +
            touching_html(every) + "<h2>The misses</h2>\n")
    cases = {case.id: case for case in asked.cases}
    for i, judged in enumerate(every):
        html += product_html(judged, vectors.letter_of(i), cases)
    return html + "</body></html>\n"
