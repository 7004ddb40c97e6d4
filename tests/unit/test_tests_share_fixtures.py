"""What `make test` needs so as not to play the same episodes in every process."""

import pytest
from xdist import is_xdist_worker


def test_the_tests_of_a_file_stay_in_one_process(request):
    if not is_xdist_worker(request):
        pytest.skip("there is one process only: `make test` runs several")
    assert request.node.nodeid.endswith("@tests/unit/test_tests_share_fixtures.py")
