# SPDX-License-Identifier: GPL-3.0-or-later
"""A short form of kill_campaign.py."""

import shutil
import unittest

try:
    from kill_campaign import CALLS, RESUMED, Campaign
except ImportError:
    Campaign = None
from option_sweep import verbs_of
from support import PROGRAM


@unittest.skipIf(Campaign is None or shutil.which("cc") is None, "needs python3-h5py and a C compiler")
class Kills(unittest.TestCase):
    def setUp(self):
        self.campaign = Campaign(PROGRAM)
        self.addCleanup(self.campaign.close)

    def test_no_verb_that_writes_is_left_out(self):
        killed = {name for name in verbs_of(PROGRAM) for call in (*CALLS, *RESUMED) if call.startswith(name)}
        # test_dataset kills a set, and a plan is written as a diagnosis is
        elsewhere = {verb for verb in verbs_of(PROGRAM) if verb.startswith("dataset ") or verb == "diagnose plan"}
        reading = {"info", "completion", "diagnose check", "diagnose catalogue"}
        self.assertEqual(set(verbs_of(PROGRAM)) - killed - elsewhere, reading)

    def test_every_moment_of_a_write(self):
        for name in ("characterize", "shear", "export", "fit power-law", "diagnose", "report", "plot", "man", "generate brownian --picture"):
            with self.subTest(verb=name):
                self.assertIn(name, CALLS)
                self.campaign.kill_everywhere(name)
                self.assertGreaterEqual(self.campaign.kills[name], 9)

    def test_new_files(self):
        self.campaign.kill_a_new_file("import")
        self.assertEqual(self.campaign.kills["import"], 12)

    def test_resumed_runs(self):
        for name in RESUMED:
            with self.subTest(verb=name):
                self.campaign.kill_and_resume(name)
                self.campaign.require_clean()
                self.assertGreater(self.campaign.kills[name], 1)


if __name__ == "__main__":
    unittest.main()
