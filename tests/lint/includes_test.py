# SPDX-License-Identifier: Apache-2.0
import includes
import sample

L = sample.LICENCE
TURN = "components/vision/include/panvo/vision/turn.hpp"
COMPASS = "components/compass/src/compass.cpp"


class IncludesTest(sample.RuleTest):
    def workspace(self, included, used="double at = vision::turn(0.5);"):
        return {TURN: L + "#pragma once\nnamespace panvo::vision {\n\nclass Turn {\n};\ndouble turn(double by_rad);\ninline constexpr double kTurn = 6.28;\n\n}\n",
                "components/compass/src/own.hpp": L + '#pragma once\n#include "panvo/vision/turn.hpp"\n',
                COMPASS: L + f"#include \"{included}\"\nnamespace panvo::compass {{\n\n{used}\n\n}}\n"}

    def test_a_name_without_its_header_is_found(self):
        for name in ("turn", "Turn", "kTurn"):
            self.assert_finds(includes, f"{COMPASS}: vision::{name} is used; include {TURN}", self.workspace("panvo/vision/pose.hpp", f"auto at = vision::{name};"))

    def test_headers_may_be_included_by_others(self):
        for header in ("panvo/vision/turn.hpp", "own.hpp"):
            self.assertEqual(self.complaints(includes, self.workspace(header)), [])

    def test_comments_other_namespaces_and_forward_declarations_need_no_header(self):
        for used in ("// vision::turn", "double at = other::turn(0.5);", "class Turn;\nvoid compare(const vision::Turn& one);"):
            self.assertEqual(self.complaints(includes, self.workspace("panvo/vision/pose.hpp", used)), [])
