"""Jobs are handed out one by one, so that results may decide what comes next."""

from collections.abc import Iterator

from labutopia_lerobot.runtime.workers import in_processes


def test_jobs_are_asked_for_while_others_are_done():
    asked: list[int] = []
    done: list[int] = []

    def jobs() -> Iterator[tuple[int]]:
        for number in range(100):
            if len(done) >= 3:
                return
            asked.append(number)
            yield (number,)

    for result in in_processes(abs, jobs(), workers=1):
        done.append(result)
    assert sorted(done) == asked
    assert len(asked) <= 5


def test_without_jobs_there_is_nothing():
    assert list(in_processes(abs, [], workers=2)) == []
