# SPDX-License-Identifier: Apache-2.0
"""Tests of the generator in tools/."""

import sys
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
INTERFACES = Path(__file__).parent.parent
sys.path[:0] = [str(INTERFACES / "tools"), str(INTERFACES / "idl" / "panvo_msgs")]

import idl  # noqa: E402
import idl_text  # noqa: E402
import message_classes  # noqa: E402
import message_table  # noqa: E402
import msg_file  # noqa: E402
import msg_from_idl  # noqa: E402
from ros2msg import definition  # noqa: E402
from type_hash import service_hash, type_hash  # noqa: E402


def wrapped(body: str, package: str = "a_msgs") -> str:
    return f"module {package} {{ module msg {{\n{body}\n}}; }};"


def parse(body: str, name: str = "Thing") -> idl.Message:
    return idl.parse(Path(f"a_msgs/msg/{name}.idl"), wrapped(body))


class Parsing(unittest.TestCase):
    def test_reads_every_kind_of_field(self):
        message = parse("""struct Thing {
            std_msgs::msg::Header header;
            string<12> label;
            sequence<std_msgs::msg::String> names;
            double matrix[9];  // row-major
            @default(value=1.0) float scale;
        };""")
        self.assertEqual([field.name for field in message.fields], ["header", "label", "names", "matrix", "scale"])
        self.assertEqual(message.fields[0].type, idl.Type("std_msgs/msg/Header"))
        self.assertEqual(message.fields[1].type, idl.Type("string", string_bound=12))
        self.assertEqual(message.fields[2].type, idl.Type("std_msgs/msg/String", is_sequence=True))
        self.assertEqual(message.fields[3], idl.Field("matrix", idl.Type("double", array_size=9), comment="row-major"))
        self.assertEqual(message.fields[4].default, "1.0")

    def test_reads_constants_and_comments(self):
        message = parse("""module Thing_Constants { const uint8 LOW = 1; const uint8 HIGH = 2; };
            // Two lines
            // of comment.
            struct Thing { uint8 level; };""")
        self.assertEqual(message.constants, [idl.Constant("LOW", "uint8", "1"), idl.Constant("HIGH", "uint8", "2")])
        self.assertEqual(message.comment, "Two lines\nof comment.")

    def assert_refuses(self, body: str, message: str):
        with self.assertRaisesRegex(idl.IdlError, message):
            parse(body)

    def test_refuses_what_the_generator_or_ros_cannot_carry(self):
        self.assert_refuses("struct Thing { wstring text; };", "Thing.idl:2: wstring is not a supported type")
        self.assert_refuses("struct Thing { };", "needs a member")
        self.assert_refuses("struct Thing { double a[SIZE]; };", "SIZE is not a size")
        self.assert_refuses("struct Thing { sequence<sequence<double>> a; };", "sequence of sequences")
        self.assert_refuses("struct Thing { double a; double a; };", "duplicate field a")
        self.assert_refuses("enum Thing { A };", "expected struct, found enum")
        self.assert_refuses("struct Thing { double a; }; struct Other { double a; };", "expected }")

        self.assert_refuses("struct Thing { double $a; };", "cannot read")

    def test_reads_a_bounded_sequence(self):
        message = parse("struct Thing { sequence<std_msgs::msg::String, 1> names; };")
        self.assertEqual(message.fields[0].type, idl.Type("std_msgs/msg/String", is_sequence=True, sequence_bound=1))

    def test_reads_a_service_as_request_and_response(self):
        body = "module Add_Request_Constants { const uint8 ONE = 1; }; struct Add_Request { double a; }; struct Add_Response { double sum; };"
        request, response = idl.parse_file(Path("a_msgs/srv/Add.idl"), wrapped(body).replace("module msg", "module srv"))
        self.assertEqual((request.full_name, response.full_name), ("a_msgs/srv/Add_Request", "a_msgs/srv/Add_Response"))
        self.assertEqual((request.file_name, response.file_name), ("a_msgs/srv/Add", "a_msgs/srv/Add"))
        self.assertEqual(request.constants, [idl.Constant("ONE", "uint8", "1")])
        self.assertEqual(request.cpp_name, "a_msgs::srv::Add_Request")

    def test_refuses_a_service_without_its_response(self):
        for body, message in (("struct Add_Request { double a; };", "expected struct"), ("struct Add_Request { double a; }; struct Sum { double s; };", "must end in _Response")):
            with self.assertRaisesRegex(idl.IdlError, message):
                idl.parse_file(Path("a_msgs/srv/Add.idl"), wrapped(body).replace("module msg", "module srv"))

    def test_names_the_line(self):
        self.assert_refuses("struct Thing {\n  double a;\n  long b;\n};", "Thing.idl:4: long")

    def test_refuses_a_file_in_the_wrong_place(self):
        with self.assertRaisesRegex(idl.IdlError, "must be a_msgs/msg/Thing.idl"):
            parse("struct Thing { double a; };", name="Other")

    def test_refuses_an_unknown_message(self):
        thing = parse("struct Thing { b_msgs::msg::Missing x; };")
        with self.assertRaisesRegex(idl.IdlError, r"contains b_msgs/msg/Missing, which is not defined; .* find_package\(b_msgs\) first"):
            idl.require_definitions({thing.full_name: thing}, {})

    def test_refuses_names_that_cpp_has_taken(self):
        thing = parse("struct Thing { double class; };")
        with self.assertRaisesRegex(idl.IdlError, r"class is a C\+\+ keyword"):
            idl.require_cpp_names({thing.full_name: thing})

    def test_reads_a_file_of_a_package_that_is_given(self):
        text = wrapped("struct Thing { double a; };")
        self.assertEqual(idl.parse_file(Path("src/msg/Thing.idl"), text, "a_msgs")[0].full_name, "a_msgs/msg/Thing")
        with self.assertRaisesRegex(idl.IdlError, "in package b_msgs"):
            idl.parse_file(Path("src/msg/Thing.idl"), text, "b_msgs")


class RosFiles(unittest.TestCase):
    """.msg and .srv files."""

    def message(self, text: str) -> idl.Message:
        return msg_file.parse(Path("msg/Thing.msg"), text, "a_msgs")[0]

    def assert_refuses(self, text: str, message: str):
        with self.assertRaisesRegex(idl.IdlError, message):
            self.message(text)

    def test_give_the_same_message_as_idl(self):
        from_msg = self.message("std_msgs/Header header\nstring<=12 label\nstd_msgs/String[] names\nfloat64[9] matrix  # row-major\nfloat32 scale 1.0\n")
        from_idl = parse("""struct Thing {
            std_msgs::msg::Header header;
            string<12> label;
            sequence<std_msgs::msg::String> names;
            double matrix[9];  // row-major
            @default(value=1.0) float scale;
        };""")
        self.assertEqual(from_msg, from_idl)

    def test_have_the_primitives_of_ros(self):
        message = self.message("bool a\nbyte b\nchar c\nfloat32 d\nfloat64 e\nint8 f\nuint64 g\nstring h\nInner i\nb_msgs/msg/Other j\nint32[<=3] k\nint32[] l\n")
        bases = ["boolean", "octet", "uint8", "float", "double", "int8", "uint64", "string", "a_msgs/msg/Inner", "b_msgs/msg/Other", "int32", "int32"]
        self.assertEqual([field.type.base for field in message.fields], bases)
        self.assertEqual(message.fields[10].type, idl.Type("int32", is_sequence=True, sequence_bound=3))

    def test_have_constants(self):
        message = self.message('uint8 LOW=1\nint8 NEGATIVE = -2  # below\nstring NAME="a # b"\nbool ON=true\nuint8 level\n')
        self.assertEqual([(c.name, c.value) for c in message.constants], [("LOW", "1"), ("NEGATIVE", "-2"), ("NAME", '"a # b"'), ("ON", "TRUE")])

    def test_have_comments(self):
        message = self.message("# What it is.\n\n# Before\nuint8 a  # beside\n\nuint8 b\n")
        self.assertEqual(message.comment, "What it is.")
        self.assertEqual([field.comment for field in message.fields], ["Before beside", ""])

    def test_may_be_empty(self):
        self.assertEqual(self.message("# Nothing.\n").fields[0].name, "structure_needs_at_least_one_member")

    def test_of_a_service_have_two_parts(self):
        request, response = msg_file.parse(Path("srv/Add.srv"), "int64 a\n---\nint64 sum\n", "a_msgs")
        self.assertEqual((request.full_name, response.full_name), ("a_msgs/srv/Add_Request", "a_msgs/srv/Add_Response"))
        for text in ("int64 a\n", "int64 a\n---\n---\n"):
            with self.assertRaisesRegex(idl.IdlError, "---"):
                msg_file.parse(Path("srv/Add.srv"), text, "a_msgs")

    def test_are_refused_by_line(self):
        self.assert_refuses("uint8 a\nwstring b\n", "Thing.msg:2: wstring is not a supported type")
        self.assert_refuses("uint8 a\nuint8 a\n", "Thing.msg:2: duplicate field a")
        self.assert_refuses("uint8\n", "Thing.msg:1: cannot read 'uint8'")
        self.assert_refuses("Inner i 3\n", "Thing.msg:1: i is a message")
        self.assert_refuses("uint8[] LIST=3\n", "Thing.msg:1: constant LIST")

    def test_become_idl_that_says_the_same(self):
        message = self.message("# Text.\nbool ON=true\nstring NAME=\"x\"\nb_msgs/Other[2] map\nstring label \"none\"\nint32[<=3] few\n")
        again = idl.parse(Path("a_msgs/msg/Thing.idl"), idl_text.text([message]))
        self.assertEqual([(f.name, f.type) for f in again.fields], [(f.name, f.type) for f in message.fields])
        self.assertEqual((again.constants, again.comment), (message.constants, message.comment))
        self.assertIn("b_msgs::msg::Other _map[2];", idl_text.text([message]))


class Output(unittest.TestCase):
    def setUp(self):
        inner = parse("struct Inner { octet level; boolean on; };", name="Inner")
        outer = parse("""module Outer_Constants { const octet OK = 0; };
            // Holds inner ones.
            struct Outer { sequence<a_msgs::msg::Inner> inner; float scale[3]; string<8> name; };""", name="Outer")
        self.messages = {message.full_name: message for message in (inner, outer)}

    def test_definition_is_in_ros2_notation(self):
        expected = "# Holds inner ones.\nbyte OK=0\nInner[] inner\nfloat32[3] scale\nstring<=8 name\n"
        expected += "\n" + "=" * 80 + "\nMSG: a_msgs/Inner\nbyte level\nbool on\n"
        self.assertEqual(definition(self.messages["a_msgs/msg/Outer"], self.messages), expected)

    def test_constants_of_a_field_precede_it(self):
        lamp = parse("""module Thing_Constants { const uint8 ON = 1; const octet LOW = 0; const uint8 OFF = 2; };
            struct Thing { double volt; uint8 state; // one of the constants
            octet level; };""")
        expected = "byte LOW=0\nfloat64 volt\nuint8 ON=1\nuint8 OFF=2\nuint8 state  # one of the constants\nbyte level\n"
        self.assertEqual(definition(lamp, {}), expected)

    def test_bounded_sequence_is_in_ros2_notation_and_has_a_hash_of_its_own(self):
        bounded = parse("struct Thing { sequence<double, 1> a; };")
        self.assertIn("float64[<=1] a\n", definition(bounded, {}))
        self.assertNotEqual(type_hash(bounded, {}), type_hash(parse("struct Thing { sequence<double> a; };"), {}))

    def test_hash_changes_with_fields_but_not_with_comments(self):
        first = parse("struct Thing { double a; };")
        commented = parse("// Why.\nstruct Thing { double a; };")
        renamed = parse("struct Thing { double b; };")
        self.assertEqual(type_hash(first, {}), type_hash(commented, {}))
        self.assertNotEqual(type_hash(first, {}), type_hash(renamed, {}))

    def test_hash_of_a_service_is_that_of_ros2(self):
        tree = idl.read_trees([Path(__file__).parents[1] / "idl"])
        known = {  # of ROS 2 Jazzy
            "rcl_interfaces/GetParameters": "RIHS01_bf9803d5c74cf989a5de3e0c2e99444599a627c7ff75f97b8c05b01003675cbc",
            "rcl_interfaces/DescribeParameters": "RIHS01_845b484d71eb0673dae682f2e3ba3c4851a65a3dcfb97bddd82c5b57e91e4cff",
            "rcl_interfaces/SetParametersAtomically": "RIHS01_0e192ef259c07fc3c07a13191d27002222e65e00ccec653ca05e856f79285fcd",
            "type_description_interfaces/GetTypeDescription": "RIHS01_69b9c19c1021405984cc60dbbb1edceb147a6538b411d812ba6afabeed962cd5",
        }
        for name, expected in known.items():
            self.assertEqual(service_hash(*name.split("/"), tree), expected, name)

    def test_table_declares_layouts_before_they_are_used(self):
        text = message_table.table(self.messages, {}, [])
        self.assertLess(text.index("extern const CdrLayout k_a_msgs_Inner_layout;"), text.index("k_a_msgs_Outer_layout{"))
        self.assertIn('{.name = "scale", .size = 4, .number = CdrNumber::kFloat, .array_size = 3, .is_array = true},', text)
        self.assertIn('{.name = "inner", .nested = &k_a_msgs_Inner_layout, .is_sequence = true},', text)

    def test_class_has_constants_defaults_and_includes(self):
        lamp = parse("""module Thing_Constants { const string NAME = "a \\"b\\""; const uint64 MOST = 18446744073709551615; const boolean ON = TRUE; };
            struct Thing { @default(value=-2) int8 state; @default(value="new") string label; sequence<boolean> lit; double scale[2];
            a_msgs::msg::Inner inner; };""")
        text = message_classes.headers({lamp.full_name: lamp}, self.messages)["a_msgs/msg/Thing.h"]
        for line in ('inline constexpr const char* NAME = "a \\"b\\"";', "inline constexpr std::uint64_t MOST = 18446744073709551615U;", "inline constexpr bool ON = true;", '#include "a_msgs/msg/Inner.h"',
                     "std::int8_t state_{-2};", 'std::string label_{"new"};', "std::vector<bool> lit_{};", "std::array<double, 2> scale_{};",
                     "::a_msgs::msg::Inner inner_{};"):
            self.assertIn(line, text)


class RosPackage(unittest.TestCase):
    """The definitions that ROS 2 gets of panvo's own messages."""

    def test_is_what_the_idl_defines(self):
        messages = idl.read_trees([INTERFACES / "idl"])
        files = sorted((INTERFACES / "idl" / "panvo_msgs" / "msg").glob("*.idl"))
        self.assertGreater(len(files), 10)
        for file in files:
            with self.subTest(file.stem):
                lines = map(msg_from_idl.converted, map(str.strip, file.read_text(encoding="utf-8").splitlines()))
                text = "\n".join(line for line in lines if line is not None)
                ours = messages[f"panvo_msgs/msg/{file.stem}"]
                theirs, = msg_file.parse(file.with_suffix(".msg"), text, "panvo_msgs")
                self.assertEqual([(field.name, field.type) for field in theirs.fields], [(field.name, field.type) for field in ours.fields])
                self.assertEqual(theirs.constants, ours.constants)

    def test_refuses_a_line_that_it_does_not_know(self):
        for line in ("union Thing switch (long) {", "string<12> label;", "double a, b;"):
            with self.assertRaises(ValueError):
                msg_from_idl.converted(line)


if __name__ == "__main__":
    unittest.main()
