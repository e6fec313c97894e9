# SPDX-License-Identifier: Apache-2.0
"""Tests of the generator in tools/."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).parent.parent / "tools"))

import idl  # noqa: E402
import message_classes  # noqa: E402
import message_table  # noqa: E402
from ros2msg import definition  # noqa: E402
from type_hash import type_hash  # noqa: E402


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
        self.assert_refuses("struct Thing { wstring text; };", "Thing.idl:2: wstring is not a type")
        self.assert_refuses("struct Thing { };", "needs a member")
        self.assert_refuses("struct Thing { double a[SIZE]; };", "SIZE is not a size")
        self.assert_refuses("struct Thing { sequence<sequence<double>> a; };", "sequence of sequences")
        self.assert_refuses("struct Thing { double a; double a; };", "a is there twice")
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
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "a_msgs/msg/Thing.idl")
            path.parent.mkdir(parents=True)
            path.write_text(wrapped("struct Thing { b_msgs::msg::Missing x; };"), encoding="utf-8")
            with self.assertRaisesRegex(idl.IdlError, "b_msgs/msg/Missing is not defined"):
                idl.read_messages(Path(folder))


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

    def test_table_lays_out_what_is_contained_first(self):
        text = message_table.table(self.messages)
        self.assertLess(text.index("k_a_msgs_Inner_layout{"), text.index("k_a_msgs_Outer_layout{"))
        self.assertIn('{.name = "scale", .size = 4, .number = CdrNumber::kFloat, .array_size = 3, .is_array = true},', text)
        self.assertIn('{.name = "inner", .nested = &k_a_msgs_Inner_layout, .is_sequence = true},', text)

    def test_failure_of_the_generator_is_reported(self):
        with self.assertRaisesRegex(message_classes.GeneratorError, "failed with status 1"):
            message_classes._run_fastddsgen("false", Path("x.idl"), Path("."))


if __name__ == "__main__":
    unittest.main()
