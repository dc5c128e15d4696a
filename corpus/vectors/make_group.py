#!/usr/bin/python3
"""Makes a group of a set from case files, with the exact facts of each case.

  make_group.py CASE.json... --name GROUP --out DIR [--distance D] [--limit] [--float]
                [--flags FLAG...] [--breaks PRODUCT...]

The group goes to DIR/GROUP.json, and DIR/set.json lists the group, too. If DIR has no set, set.json
is made. A case is two features (its option `query`) or a mesh; corpus/README.md describes
case files. First times, pairs and least distances come from the Python module `assay`. Whether
features pass through each other or only touch, and by which polynomial, is computed in whole
numbers (exact.py).

Each case gets the flags that follow from its numbers, times and pairs, and all flags of --flags.
"""
import argparse
import json
import math
import re
from pathlib import Path

import vectors
from exact import Features, vanishes_within
from hosted import assay, demand_module
from vectors import primitive, want

SIDES = ((0, 1), (1, 2), (2, 0))
RESULTS = ("free", "acceptable", "collision")


def points_of(frame, indices):
    return [frame[i] for i in indices]


def as_mesh(query):
    """Returns a mesh of two triangles without area, each a feature, and its points (t = 0, 1)."""
    corners = [0, 0, 0, 1, 2, 3] if query.first == 1 else [0, 1, 1, 2, 3, 3]
    return [[0, 1, 2], [3, 4, 5]], *(points_of(end, corners) for end in (query.t0, query.t1))


def least_distance(query):
    found = assay.least_distance(*as_mesh(query), jobs=1)
    return found.distance if found else math.inf  # beyond all doubles


def comes_nearer(query, distance):
    """Returns whether the features come nearer than (1 - 2^-60) times the distance."""
    return assay.judge(*as_mesh(query), separation=(distance, -distance * 2.0**-60),
                       jobs=1).answer == "collision"


def facts_of(result, first, candidates):
    """Returns facts of a result. Their polynomial is a candidate with a zero in `first`."""
    polynomial = [0, 1] if first[1] == 0 else primitive(
        next(p for p in candidates if vanishes_within(p, *first)))
    return {"result": result, "first_time": list(map(float, first)),
            "polynomial": list(map(str, polynomial))}


def query_facts(query, distance=0):
    """Returns facts of a contact or, if the distance is above 0, of coming within the distance."""
    stated = {"result": "free"}
    if distance:
        stated["distance"], least = distance, least_distance(query)
        stated.update({"least_distance": least} if least < math.inf else {})
    found = assay.judge(*as_mesh(query), separation=distance, jobs=1)
    if found.answer == "collision":
        more = comes_nearer(query, distance) if distance else query.passes()
        stated.update(facts_of("collision" if more else "acceptable", found.first,
                               query.within(distance) if distance else query.events()))
    return stated


def number_flags(t0, t1, is_float):
    numbers = [abs(x) for p in t0 + t1 for x in p]
    least, greatest = min((x for x in numbers if x), default=0), max(numbers)
    extent = max(max(c) - min(c) for c in zip(*t0))
    longest = max(abs(b - a) for p, q in zip(t0, t1) for a, b in zip(p, q))
    if greatest == 0:
        return {"AtRest"}
    bits = 24 if is_float else 53
    return {flag for flag, holds in (
        ("Denormal", least < (2.0**-126 if is_float else 2.0**-1022)),
        ("LargeNumbers", greatest >= (2.0**40 if is_float else 2.0**340)),
        ("MixedScales", math.frexp(greatest)[1] - math.frexp(least)[1] > bits),
        ("FarFromOrigin", extent > 0 and greatest >= extent * 2.0**(bits // 2)),
        ("AtRest", longest == 0),
        ("HugeStep", extent > 0 and longest >= 2.0**10 * extent)) if holds}


def query_flags(query, stated, is_float):
    flags = number_flags(query.t0, query.t1, is_float)
    first, distance = stated.get("first_time"), stated.get("distance", 0)
    if not distance and not any(query.coplanarity):
        flags.add("CoplanarThroughout")
    if first:
        flags |= {"AtStart"} if first[1] == 0 else {"AtEnd"} if first[0] == 1 else set()
        return flags | ({"AtDistance"} if distance and stated["result"] == "acceptable" else set())
    extent = distance or max(max(c) - min(c) for c in zip(*query.t0))
    near = extent * 2.0**(-10 if is_float else -26)
    return flags | ({"NearMiss"} if least_distance(query) - distance <= near else set())


def features_of(judgement, k, t0, t1):
    """Returns the two features of pair k that meet first; None for piercing or same_vertices."""
    kind = assay.FEATURE_KINDS[judgement.features[k][0]]
    if kind not in ("vertex_face", "edge_edge"):
        return None
    four = judgement.features[k][1:5]
    return Features(1 if kind == "vertex_face" else 2, points_of(t0, four), points_of(t1, four))


def pair_passes(triangles, judgement, k, t0, t1):
    if not features_of(judgement, k, t0, t1):
        return assay.FEATURE_KINDS[judgement.features[k][0]] == "piercing"
    a, b = (triangles[t] for t in judgement.pairs[k])
    asked = [(1, (v, *face)) for one, face in ((a, b), (b, a)) for v in one]
    asked += [(2, (a[i], a[j], b[m], b[n])) for i, j in SIDES for m, n in SIDES]
    return any(len(set(four)) == 4 and
               Features(first, points_of(t0, four), points_of(t1, four)).passes()
               for first, four in asked)


def step_facts(triangles, t0, t1, flags, is_float):
    """Returns facts of a step of a mesh, and adds the flags of the step to `flags`."""
    judgement = assay.judge(triangles, t0, t1, jobs=1)
    flags |= number_flags(t0, t1, is_float)
    if judgement.answer == "free":
        return {"result": "free"}
    pairs, times = judgement.pairs.tolist(), judgement.times.tolist()
    flags |= {"ManyContacts"} if len(pairs) >= 50 else set()
    if any(set(triangles[a]) & set(triangles[b]) for a, b in pairs):
        flags.add("SharedVertex")
    passing = any(pair_passes(triangles, judgement, k, t0, t1) for k in range(len(pairs)))
    query = features_of(judgement, times.index(list(judgement.first)), t0, t1)
    stated = facts_of("collision" if passing else "acceptable", judgement.first,
                      query.events() if query else [])
    if query:
        flags |= query_flags(query, stated, is_float)
    stated["pairs"] = [[*pair, *time] for pair, time in zip(pairs, times)]
    return stated


def mesh_facts(case, is_float):
    """Returns facts and flags of a mesh."""
    triangles, frames = case["triangles"], case["frames"]
    script = case.get("script") or [[i, i + 1, "commit"] for i in range(len(frames) - 1)]
    flags = {"Sequence"} if len(script) > 1 else set()
    places = {tuple(tuple(sorted(tuple(x[v]) for v in t)) for x in frames) for t in triangles}
    flags |= {"Duplicate"} if len(places) < len(triangles) else set()
    steps = [{"from": a, "to": b, "commit": how == "commit",
              **step_facts(triangles, frames[a], frames[b], flags, is_float)}
             for a, b, how in script]
    worst = max((step["result"] for step in steps), key=RESULTS.index)
    return {"result": worst, "triangles": triangles, "frames": frames, "steps": steps}, flags


def read_case(file):
    """Reads a case file. Refuses every file that the project's own reader refuses."""
    from assay import _judge
    try:
        _judge.read_case(str(file))
    except ValueError as problem:
        raise vectors.Wrong(str(problem)) from None
    case = vectors.read_json(file)
    query = case["options"].get("query")
    want(query in (None, "vertex-face", "edge-edge"), file, f"its option query is unknown: {query}")
    want(not query or (len(case["frames"]) == 2 and all(len(x) == 4 for x in case["frames"])), file,
         "a query has two frames of four points")
    return case


def case_of(file, given, features, known):
    case = read_case(file)
    want(case["options"].get("query", "mesh") == features, file,
         f"its kind is not {features}, but the first case has this kind")
    if features == "mesh":
        stated, flags = mesh_facts(case, given.float)
    else:
        t0, t1 = case["frames"]
        query = Features(1 if features == "vertex-face" else 2, t0, t1)
        stated = {**query_facts(query, given.distance), "t0": t0, "t1": t1}
        flags = query_flags(query, stated, given.float)
    flags |= set(given.flags)
    made = {"id": re.sub(r"[^\w.:-]", "-", case["id"]), "about": case["about"], **stated,
            "flags": [flag for flag in known if flag in flags],
            "hard": {"kind": "unknown", "bits": 0}, "source": case["source"] or str(file)}
    return {**made, "breaks": given.breaks} if given.breaks else made


def main(words):
    parser = vectors.Parser(prog="make_group.py", description=__doc__,
                            formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", metavar="CASE.json")
    parser.add_argument("--name", required=True, metavar="GROUP")
    parser.add_argument("--out", required=True, metavar="DIR", help="the folder of the set")
    parser.add_argument("--distance", type=float, default=0, metavar="D",
                        help="ask whether features come within D")
    parser.add_argument("--limit", action="store_true", help="ask how far a step can be taken")
    parser.add_argument("--float", action="store_true", help="the coordinates are float32")
    parser.add_argument("--flags", nargs="+", default=[], metavar="FLAG")
    parser.add_argument("--breaks", nargs="+", default=[], metavar="PRODUCT",
                        help="products that fail on these cases")
    given = parser.parse_args(words)
    demand_module()
    out = Path(given.out)
    is_there = (out / "set.json").exists()
    there = vectors.VectorSet(out if is_there else None)
    info = there.info
    ids = [case.id for case in there.cases if is_there and case.group != given.name]
    if not is_there:
        info.update(version="0", profile="own", groups=[], licence="that of its cases", cite="")
    for flag in given.flags:
        want(flag in info["flags"], "--flags", f"there is no flag {flag}")
    want(0 <= given.distance < math.inf, "--distance", "must be a finite number >= 0")
    features = read_case(given.files[0])["options"].get("query", "mesh")
    group = {"schema": vectors.SET_SCHEMA, "version": info["version"], "group": given.name,
             "features": features,
             "question": "limit" if given.limit else "distance" if given.distance else "contact",
             "precision": "float32" if given.float else "double", "licence": info["licence"]}
    cases = [case_of(file, given, features, info["flags"]) for file in given.files]
    ids += [case["id"] for case in cases]
    for name in set(ids):
        want(ids.count(name) == 1, f"case {name}", "occurs twice in the set")
    vectors.write_set(out, info, [(group, cases)])


if __name__ == "__main__":
    vectors.end_with(main)
