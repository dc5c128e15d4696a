"""The matrix of a score as one page of HTML, without scripts and without a network.

Products stand in columns, flags and groups in rows; a cell says its misses in words and signs
beside its colour. Below stand the misses of each product, each with its sentence. The same results
give the same bytes. `vectors.py score --out FILE.html` writes it.
"""
import collections
import statistics
from pathlib import Path

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
.wide { overflow: auto; max-height: 92vh; }
.wide th:first-child { position: sticky; left: 0; background: var(--ground); font-weight: 600; }
.wide thead th { position: sticky; top: 0; z-index: 1; background: var(--ground); }
.wide thead th:first-child { z-index: 2; }
.matrix tbody th { min-width: 17rem; }
[title] { cursor: help; }
.matrix thead th:not(:first-child) { min-width: 4.2rem; overflow-wrap: normal; }
.matrix small, .chip small { display: block; line-height: 1.3; }
.matrix td, .matrix code { white-space: nowrap; }
.matrix code { display: block; }
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
  thead, .sideways { display: none; }
  tbody, tr, tbody th { display: block; }
  .wide { max-height: none; }
  .wide th:first-child { position: static; }
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
<li class="chip bad"><b>&#x2717; 3/17</b> <small>17 cases of the row asked, 3 missed</small></li>
<li class="chip open"><b>! 0/17</b> <small>none missed, but late, alarms or unanswered</small></li>
<li class="chip good"><b>&#x2713; 0/17</b> <small>all 17 right</small></li>
<li class="chip none">&ndash; <small>none asked: the contract leaves all of the row out</small></li>
</ul>
<p>The number asked includes the unanswered, not the unsupported, so it differs between products.
Rest the pointer on a cell for all its counts. Colours mean the same in all tables. <span
class="sideways">A wide table scrolls sideways.</span> <b>To ask again</b> the cases of a row:
<code>python3 corpus/vectors/vectors.py run --detector build/release/peers/NAME.so --group
ROW</code>, for Assay <code>--arithmetic NAME</code>; <code>--group</code> takes a group or a flag.
README.md says what that needs.</p>
"""

WORDS = """<ul>
<li>A case counts once in a cell, as the worst of its steps: missed, late, alarm, unanswered or
right. The sign before the misses: &#x2717; some; ! none, but late, alarms or unanswered; &#x2713;
all right. Cases that a cell does not name are right. Pairs left out are counted further below.</li>
<li>A <b>miss</b>: the product answers "free" though features meet, or, when asked how far a step is
safe, names a share at or beyond the contact. It counts even if the product promises nothing of the
kind: <code>corpus/peers</code> has what each promises, FINDINGS.md what causes defects.</li>
<li><b>Late</b>: it reports a time after that of the first meeting, a touch included, even in the
last digit and within its own tolerance; of an interval, its lower end counts. A dash means that it
reports no time. An <b>alarm</b> is a contact in a step without any: false, but safe. A wrong pair
beside a right one, or an early time, is none.</li>
<li><b>Unanswered</b> is undecided; an error (the product reports one itself, or names a time or
share that is not from 0 to 1); a crash; or a timeout.</li>
<li><b>Unsupported</b> cases were not asked: they are outside the contract of the product, that is,
the inputs that its plug-in declares that it takes. All plug-ins leave out distances, limits (how
far a step may go), starts in contact, coordinates above 1e6, and edges shorter than 1e-6 but not 0;
what else one leaves out, or takes, stands below its name. Rest the pointer on the number to see how
many cases those are: first by what is asked (contact, distance, limit: these add up), then by flag
(these overlap).</li>
<li>Features <b>pass</b> if they meet at a time between 0 and 1, where their cubic changes its sign:
at a simple root or a triple one. If they meet and never pass, they <b>only touch</b>: at t = 0 or 1
alone, in one plane throughout, or at a double root; or they come exactly as near as the distance
asked about. Both answers are right here. A product's own promise can still make one of them wrong:
the first of FINDINGS.md is such a case.</li>
<li>Lengths such as eta are in the unit of the coordinates. Times are shares of the step.</li>
</ul>\n"""

TOUCHING = """<h2>Where features only touch</h2>
<p>This list counts steps, not cases, and only those that a product answered. If features are closed
sets, a touch is a contact; a product that counts overlaps only answers free, or allows a step up to
the touch or beyond. Both are right, and a product should hold to one of them.</p>\n<ul>\n"""

# Words: of a product, its plug-in or arithmetic, what it is, and the flag or features of misses by
# design, with a sentence; of a flag, its meaning and pitfall, where set.json needs more; of a case,
# what stands in place of its `about`; of the kinds of a group; of where the answers are from, of a
# mesh's flags, and of misses.
MORE = vectors.read_json(Path(__file__).with_name("matrix.words"))

# What is counted of a product, and the words that stand before the ids.
LISTED = (("late", "Late times"), ("alarm", "Alarms"),
          *((o, f"Unanswered: {o}") for o in vectors.NO_ANSWERS))
COLUMNS = (("late", ("late",)), ("alarms", ("alarm",)), ("unanswered", vectors.NO_ANSWERS),
           ("unsupported", ("unsupported",)))


def escaped(text):
    for sign, name in (("&", "amp"), ("<", "lt"), (">", "gt"), ('"', "quot")):
        text = text.replace(sign, f"&{name};")
    return text


def count_text(count, one, many):
    return f"{count} {one if count == 1 else many}"


def interval(time):
    lo, hi = map(vectors.decimal, time)
    return f" at t = {lo}" if lo == hi else f" between t = {lo} and {hi}"


def split_text(outcomes):
    return ", ".join(f"{outcomes[o]} {o}" for o in vectors.OUTCOMES if outcomes.get(o))


def kind_of(outcomes):
    """The colour and the sign of what cases came to."""
    if outcomes["miss"]:
        return "bad", "&#x2717;"
    return ("open", "!") if set(outcomes) - {"right", "unsupported"} else ("good", "&#x2713;")


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
    kind, sign = kind_of(outcomes)
    small = f"<small>{others}</small>" if others else ""
    return (f'<td class="{kind}" data-of="{letter}" title="{split_text(outcomes)}">'
            f'<b>{sign} {outcomes["miss"]}/{asked}</b>{small}</td>')


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


def left_out_text(judged, cases):
    """The unsupported cases by question and by flag, each of how many."""
    def counted(words_of):
        left, every = (collections.Counter(w for i in ids for w in words_of(cases[i]))
                       for ids in (judged.ids("unsupported"), judged.outcome))
        return ", ".join(f"{word} {count} of {every[word]}" for word, count in left.most_common())
    asked, flags = counted(lambda case: [case.question]), counted(lambda case: case.flags)
    return asked and f"by what is asked: {asked} (these add up); by flag: {flags} (these overlap)"


def products_html(every, cases):
    html = ('<div class="wide"><table>\n<thead><tr><th scope="col">product <small>NAME: what it is'
            "</small></th><th>cases asked</th><th>misses</th>" +
            "".join(f"<th>{words}</th>" for words, _ in COLUMNS) + "</tr></thead>\n<tbody>\n")
    for i, judged in enumerate(every):
        counts = collections.Counter(judged.outcome.values())
        way, about = MORE["products"].get(judged.name(), ("", ""))[:2]
        about = f"<br><code>{way}</code>: {escaped(about)}" if way else ""
        kind, sign = kind_of(counts)
        titles = {"late": size_text(judged.late_by), "unsupported": left_out_text(judged, cases),
                  "unanswered": split_text({o: counts[o] for o in vectors.NO_ANSWERS})}
        html += (f'<tr><th scope="row">{vectors.letter_of(i)} &nbsp;{escaped(judged.name())} '
                 f"<small>version {escaped(judged.product['version'])}{about}</small></th>"
                 f'<td data-of="cases asked">{len(judged.outcome) - counts["unsupported"]}</td>'
                 f'<td class="{kind}" data-of="misses"><b>{sign} {counts["miss"]}</b></td>')
        for words, outcomes in COLUMNS:
            count, title = len(judged.ids(*outcomes)), titles.get(words)
            html += (f'<td class="{"open" if count and words != "unsupported" else "none"}" '
                     f'data-of="{words}"' + (f' title="{escaped(title)}">' if title else ">") +
                     f'{"&ndash;" if words == "late" and not judged.times else count}</td>')
        html += "</tr>\n"
    return html + "</tbody></table></div>\n"


def size_text(shares):
    return (f"by {statistics.median(shares):.1g} of the step (median) to {max(shares):.1g} (worst)"
            if shares else "")


def touching_html(every):
    items = "".join(f"<li>{vectors.letter_of(i)} {escaped(judged.name())}: "
                    f"{judged.closed} called contact, {judged.open} free</li>\n"
                    for i, judged in enumerate(every) if judged.closed or judged.open)
    return f"{TOUCHING}{items}</ul>\n" if items else ""


def case_html(case, judged):
    at, answer = judged.missed[case.id]
    time = case.steps[at].first_time
    step = f"step {at + 1}: " if len(case.steps) > 1 else ""
    told = f"first contact{interval(time)}" if time else "contact"
    said = f"share {vectors.decimal(answer['share'])}" if "share" in answer else answer["answer"]
    about = MORE["cases"].get(case.about, case.about)
    return (f"<li><code>{escaped(case.id)}</code> {escaped(about)}<br>"
            f"<small>{step}{told}; answered {escaped(said)}. "
            f"{escaped(', '.join(case.flags))}</small></li>\n")


def product_html(judged, letter, cases):
    misses = judged.ids("miss")
    told = count_text(len(misses), "miss", "misses") if misses else "no miss"
    html = f"<h3>{letter} {escaped(judged.name_and_version())}: {told}</h3>\n"
    if misses:
        items = "".join(case_html(cases[i], judged) for i in misses)
        for word, words in MORE["products"].get(judged.name(), [])[2:]:
            count = sum(word in (cases[i].features, *cases[i].flags) for i in misses)
            html += f"<p>{words.format(count)}</p>\n"
        html += f'<ul class="cases">\n{items}</ul>\n'
    for outcome, words in LISTED:
        ids = judged.ids(outcome)
        if ids:
            codes = "".join(f" <code>{escaped(i)}</code>" for i in ids)
            size = f", {size_text(judged.late_by)}" if outcome == "late" else ""
            html += f"<p>{words} ({len(ids)}{size}):{codes}</p>\n"
    if judged.early_by:
        html += (f"<p>Early, which is safe: {len(judged.early_by)} of {judged.times} first times, "
                 f"{size_text(judged.early_by)}</p>\n")
    html += (f"<p>Pairs of triangles: it left out {judged.missing:,} of {judged.met:,} in contact "
             f"(touching ones, too), and {judged.spurious:,} of {judged.named:,} listed are not in "
             "contact. Counted in mesh steps where it found a contact that is no touch.</p>\n"
             if judged.gave_pairs else "<p>It lists no pairs of triangles.</p>\n")
    if judged.uses:
        limits = [i for i, outcome in judged.outcome.items()
                  if cases[i].question == "limit" and outcome != "unsupported"]
        ends = [cases[i].json["result"] for i in limits]
        html += (f"<p>Limits, how much of a step is safe: {len(limits)} cases, of which "
                 f"{ends.count('collision')} end in a contact ({len(set(limits) & set(misses))} "
                 f"missed), {ends.count('acceptable')} touch, {ends.count('free')} are free; in "
                 f"the median of {len(judged.uses)} safe answers, touches aside, it allows "
                 f"{100 * statistics.median(judged.uses):.1f} % of the way to the contact (or of "
                 "the whole step if free); a margin is no fault</p>\n")
    return html


def page(asked, every):
    """The page of products that were judged on a set."""
    info = asked.info
    flags, groups = asked.members()
    cases = {case.id: case for case in asked.cases}
    kinds = {group["group"]: group for group in asked.groups}
    is_own = info["profile"] == "core"  # the set of this folder

    def again(name, words):
        return f"<br><small>{escaped(words)} <code>--group {escaped(name)}</code></small>"

    def flag_words(name):
        about, wrong = info["flags"][name]["about"], info["flags"][name]["wrong"]
        about, wrong = is_own and MORE["flags"].get(name) or (about, wrong)
        return again(name, f"{about} Pitfall: {wrong}")

    def group_words(name):
        kind = {key: MORE["kinds"][kinds[name][key]] for key in vectors.KIND}
        found = (" Smallest inputs of the defects in FINDINGS.md, of any product: no fair sample."
                 if name.endswith("-findings") else "")
        return again(name, f"{kind['question'].format(kind['features'])} Coordinates are "
                     f"{kind['precision']}.{found}")

    html = (f"{HEAD}<h1>Who misses what</h1>\n<p>{info['cases']:,} small hard cases of continuous "
            "collision detection, whose answers are known exactly. <span class=\"quiet\">Set "
            f"{escaped(info['version'])}, a selection called {escaped(info['profile'])}; digest of "
            f"its files, which all results here state: <code>{info['digest']}</code></span></p>\n"
            f"{MORE['origin'] * is_own}{WORDS}{products_html(every, cases)}<h2>By what makes a "
            f"case hard</h2>\n{LEGEND}<p>A case may have several flags, or none "
            f"({sum(not case.flags for case in asked.cases)} cases), and has one group.</p>\n"
            f"{MORE['mesh'] * is_own}" +
            matrix_html("flag", flags, every, flag_words) +
            "<h2>By group</h2>\n" + matrix_html("group", groups, every, group_words) +
            touching_html(every) + "<h2>The misses</h2>\n" + MORE["misses"])
    for i, judged in enumerate(every):
        html += product_html(judged, vectors.letter_of(i), cases)
    return html + "</body></html>\n"
