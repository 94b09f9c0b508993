# SPDX-License-Identifier: GPL-3.0-or-later
"""What facts.py takes for a fact, and for a difference."""

import math
import unittest

import facts


class Differences(unittest.TestCase):
    def found(self, one, other):
        return list(facts.differences(one, other))

    def test_sentences_times_and_paths_are_no_facts(self):
        told = {"verdict": "tied", "seconds": 3.1, "notes": ["a"], "report": "/a/b", "remainder": {"where": "G' at 3 Hz", "p_value": 0.5},
                "where": [{"axis": "time", "sentence": "G' rises"}]}
        self.assertEqual(facts.facts_in(told), {"verdict": "tied", "remainder": {"p_value": 0.5}, "where": [{"axis": "time"}]})

    def test_causes_are_in_any_order(self):
        causes = [{"name": "ageing", "posterior": 0.5}, {"name": "slip", "posterior": 0.4}]
        self.assertEqual(facts.facts_in({"causes": causes}), facts.facts_in({"causes": causes[::-1]}))

    def test_numbers_differ_by_a_part_in_a_million(self):
        self.assertEqual(self.found({"value": 1.0}, {"value": 1.0 + 5e-7}), [])
        self.assertEqual(self.found({"value": 1e-9}, {"value": 1.00001e-9}), ["value: 1e-09 -> 1.00001e-09"])
        self.assertEqual(len(self.found({"value": 1.0}, {"value": math.inf})), 1)
        self.assertEqual(len(self.found({"value": 1.0}, {"value": None})), 1)

    def test_probabilities_differ_by_their_difference(self):
        self.assertEqual(self.found({"posterior": 1e-12}, {"posterior": 2e-12}), [])
        self.assertEqual(len(self.found({"posterior": 0.5}, {"posterior": 0.50001})), 1)

    def test_an_interval_is_as_exact_as_its_largest_number(self):
        interval = {"value": 1.0, "low": 1e-9, "high": 2.0}
        self.assertEqual(self.found(interval, interval | {"low": 1.5e-9}), [])
        self.assertEqual(len(self.found(interval, interval | {"low": 1e-5})), 1)

    def test_names_truths_and_what_is_missing(self):
        self.assertEqual(self.found({"set": ["a", "b"]}, {"set": ["a", "c"]}), ['set/1: "b" -> "c"'])
        self.assertEqual(self.found({"set": ["a"]}, {"set": ["a", "b"]}), ['set: ["a"] -> ["a", "b"]'])
        self.assertEqual(self.found({"detected": True}, {"detected": False}), ["detected: true -> false"])
        self.assertEqual(self.found({"detected": True}, {"detected": 1}), ["detected: true -> 1"])
        self.assertEqual(sorted(self.found({"old": 1}, {"new": 1})), ["/new: is new", "/old: is missing"])

    def test_digests_count_on_one_kind_of_processor(self):
        one, other = {"digest": {"this": "1"}}, {"digest": {"that": "2"}}
        self.assertEqual(self.found(facts.comparable(one, other), other), [])
        same = {"digest": {"this": "2"}}
        self.assertEqual(len(self.found(facts.comparable(one, same), same)), 1)

    def test_every_experiment_has_its_facts(self):
        self.assertEqual(facts.names_in_archive() | {f"recipe-{name}" for name in facts.RECIPES}, set(facts.read_expected()))


if __name__ == "__main__":
    unittest.main()
