# SPDX-License-Identifier: Apache-2.0
"""Checks a recording of left and right folders with a calibration."""
import kitti
from findings import Findings

CALIBRATIONS = (("stereo_params.xml",), ("left.yaml", "right.yaml"), ("stereo.yaml",), ("stereo.yml",),
                ("intrinsics.yml", "extrinsics.yml"))


def check(folder):
    findings = Findings(folder)
    kitti.check_pairs(findings, ["left", "right"])
    complete = [names for names in CALIBRATIONS if all((folder / name).is_file() for name in names)]
    if complete:
        findings.facts.append(f"calibration: {' and '.join(complete[0])}")
    else:
        known = ", or ".join(" and ".join(names) for names in CALIBRATIONS)
        findings.problems.append(f"there is no calibration: {known} (panvo calibrate stereo makes one)")
    findings.notes.append("times are not recorded: 30 Hz is assumed (--set dataset_player.rate_hz=HZ)")
    return findings
