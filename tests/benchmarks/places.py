# SPDX-License-Identifier: Apache-2.0
"""panvo bench places: recognition of places on other days and on other campuses, with 95 % intervals, as one Markdown page.

Each pair is a library and a drive; panvo_evaluate_places builds landmarks from the one and compares every panorama of the other with all of them.
"""
import argparse
import json
import math
import pathlib
import sys

from report import Failed, add_page_arguments, figure, machine, run, table, write_page

ELSEWHERE = "elsewhere"  # drive and library on different campuses: every match is wrong
NORMAL = 1.96            # quantile of the normal distribution for a two-sided interval of 95 %


def match(programs, library, drive, out):
    """Matches of a drive with a library; see panvo_evaluate_places."""
    run([programs / "panvo_evaluate_places", drive, "--library-from", library, "--only-journey", "--out", out])
    return json.loads((out / "places.json").read_text(encoding="utf-8"))


def share(found, of):
    """Wilson's interval of a share: lower and upper bound."""
    middle = (found + NORMAL**2 / 2) / (of + NORMAL**2)
    half = NORMAL * math.sqrt(found * (of - found) / of + NORMAL**2 / 4) / (of + NORMAL**2)
    return max(0.0, middle - half), min(1.0, middle + half)


def most_expected(count):
    """Upper 95 % bound of the expected number of events of which `count` were seen, which are Poisson distributed; 3.0 for none."""
    low, high = 0.0, 10.0 + 3.0 * count
    for _ in range(60):
        middle = (low + high) / 2
        at_most = sum(math.exp(-middle + k * math.log(middle) - math.lgamma(k + 1)) for k in range(count + 1))
        low, high = (middle, high) if at_most > 0.05 else (low, middle)
    return high


COLUMNS = ("drive", "n", "revisits recognised", "%, interval", "position, m: median", "95 %", "worst", "heading, deg: worst", "panoramas", "wrong", "wrong rate below")


def quantile(values, part):
    return sorted(values)[min(len(values) - 1, int(part * len(values)))] if values else None


def row(name, results):
    journeys = [result["journey"] for result in results]
    matches = [each for journey in journeys for each in journey["matches"]]
    panoramas = sum(result["panoramas"] for result in results)
    if name.startswith(ELSEWHERE):
        wrong, cells = len(matches), ["-"] * 6
    else:
        found, revisits = sum(journey["found"] for journey in journeys), sum(result["revisits"] for result in results)
        wrong = sum(journey["wrong"] for journey in journeys)
        low, high = share(found, revisits)
        right = [each for each in matches if each["right"]]
        errors = [each["position_error_m"] for each in right]
        cells = [f"{found} of {revisits}", f"{100 * found / revisits:.0f} ({100 * low:.0f} to {100 * high:.0f})",
                 figure(quantile(errors, 0.5), 2), figure(quantile(errors, 0.95), 2), figure(max(errors, default=None), 2),
                 figure(max((abs(each["heading_error_deg"]) for each in right), default=None), 2)]
    return [name, str(len(results)), *cells, str(panoramas), str(wrong), f"{most_expected(wrong) / panoramas:.1e}"]


def measure(programs, pairs, work):
    """Rows of the table, and what is missing."""
    results, missing = {}, []
    for name, library, drive in pairs:
        library, drive = pathlib.Path(library), pathlib.Path(drive)
        print(f"{name}: {drive.name} with the places of {library.name}", file=sys.stderr)
        try:
            result = match(programs, library, drive, work / f"{name}-{library.name}-{drive.name}")
        except Failed as error:
            missing.append(f"{name}, {drive.name}: {error}")
            continue
        results.setdefault(name, []).append(result)
    return [row(name, results[name]) for name in results], missing


def page(version, rows, missing, where):
    lines = ["# Recognition of places by this version", "", f"Written by `panvo bench places`: panvo {version}, {where}.", "",
             "The library is a drive at noon in summer. Every panorama of another drive is compared with the whole library, without a prior position.",
             "Intervals are of 95 %. Successive panoramas are not independent of each other, so that the true bound of the wrong rate is higher.", "",
             "hour: in the evening; night: street lamps; rain: overcast, drops and dirt on the lens, traffic; bare: trees without leaves; rows: rows of equal buildings; twins:",
             "pairs of junctions with the same buildings; car_parks: equal bays with other cars; hall: indoors, a fifth of the goods are others; these four also in the library.",
             "elsewhere: the library of another campus, of the same layout, where every match is wrong.", ""]
    lines += table(COLUMNS, rows) if rows else ["Nothing was measured."]
    if missing:
        lines += ["", "## Not measured", "", *(f"- {text}" for text in missing)]
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(prog="panvo bench places", description=__doc__.splitlines()[0])
    parser.add_argument("--pair", nargs=3, action="append", required=True, metavar=("NAME", "LIBRARY", "DRIVE"))
    add_page_arguments(parser)
    arguments = parser.parse_args()
    arguments.work.mkdir(parents=True, exist_ok=True)
    rows, missing = measure(arguments.programs, arguments.pair, arguments.work)
    text = page(arguments.version_text, rows, missing, machine())
    print(text)
    write_page(text, arguments.out)
    return 0 if rows else 1


if __name__ == "__main__":
    sys.exit(main())
