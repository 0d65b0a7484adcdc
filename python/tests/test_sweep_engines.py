"""process: one sweep on this machine, by Dask and by Slurm: the same table, also where workers are killed in the middle."""

import asyncio
import concurrent.futures
import io
import json
import os
import signal
import subprocess
import sys
import threading
import time
import types
from pathlib import Path

import pytest

import phare
import slurm_here
from phare import sweep
from phare.sweep import dask_engine
from phare.sweep.engine import Work

PACKAGE = str(Path(phare.__file__).parents[1])


@pytest.fixture(scope="module")
def plan(examples, tmp_path_factory):
    """Five drives of two frames: four aims, and a lamp that cannot be read."""
    folder = tmp_path_factory.mktemp("plan")
    (folder / "broken.ies").write_text("IESNA:LM-63-2002\nnothing\n")
    runs = "".join(f'[[run]]\naim = {aim}\nlamp = "{examples / "low_beam.ies"}"\n' for aim in (-0.3, -0.5, -0.7, -0.9))
    runs += '[[run]]\nlamp = "broken.ies"\n'
    measure = '[[measure]]\nname = "edge_m"\nrange_lx = 5\ny_m = -1.75\n'
    (folder / "plan.toml").write_text(f'kind = "list"\n[fixed]\nframes = 2\nsize = "160x90"\n{runs}{measure}')
    return sweep.read_plan(folder / "plan.toml")


@pytest.fixture(scope="module")
def here(plan, tmp_path_factory):
    """Its table by this machine alone."""
    done = sweep.run_plan(plan, tmp_path_factory.mktemp("here"), progress=io.StringIO())
    assert done.failed == [5] and done.table.edge_m[:4].is_monotonic_decreasing and done.table.picture_hash[:4].nunique() == 4
    return done.file.read_bytes()


def kill_a_job(folder: Path, *, not_before: int = 0) -> threading.Thread:
    """Kills, as soon as so many rows are there, the process that is driving a job, by the name of its unfinished folder."""

    def watch():
        until = time.monotonic() + 120
        while time.monotonic() < until:
            making = list(folder.glob("jobs/*.making-*"))
            if making and len(list(folder.glob("rows/*.json"))) >= not_before:
                thread.killed = int(making[0].name.rpartition("-")[2])
                os.kill(thread.killed, signal.SIGKILL)
                return
            time.sleep(0.005)

    thread = threading.Thread(target=watch)
    thread.killed = None
    thread.start()
    return thread


def cli(plan, out, *words):
    environment = {**os.environ, "PYTHONPATH": PACKAGE}
    command = [sys.executable, "-m", "phare.sweep", str(plan.file), "--out", str(out), *words]
    return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=300)


def leftovers(out: Path) -> list[Path]:
    return [*out.glob("jobs/*.making-*"), *out.glob("rows/*.part")]


# ---- Dask


@pytest.fixture()
def dask(tmp_path):
    """A scheduler and two workers, each a process of its own: (address, [scheduler, workers])."""
    pytest.importorskip("distributed", reason="Dask is not tried: apt-get install python3-distributed")
    file, environment = tmp_path / "scheduler.json", {**os.environ, "PYTHONPATH": PACKAGE}
    quiet = dict(env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=tmp_path)
    module = [sys.executable, "-m", "distributed.cli.dask_{}", "--no-dashboard", "--scheduler-file", str(file)]

    def start(what, *more):
        return subprocess.Popen([word.format(what) for word in module] + list(more), **quiet)

    running = [start("scheduler", "--host", "127.0.0.1", "--port", "0")]
    running += [start("worker", "--nthreads", "1", "--no-nanny", "--host", "127.0.0.1") for _ in range(2)]
    until = time.monotonic() + 60
    while not file.exists() and time.monotonic() < until:
        time.sleep(0.05)
    yield json.loads(file.read_text())["address"], running
    for each in running:
        each.kill()
        each.wait()


def test_dask_gives_the_same_table_though_a_worker_is_killed(plan, here, dask, tmp_path):
    address, running = dask
    out, said = tmp_path / "out", io.StringIO()
    killer = kill_a_job(out, not_before=1)
    done = sweep.run_plan(plan, out, engine=sweep.Dask(address), progress=said)
    killer.join()
    assert killer.killed in [worker.pid for worker in running[1:]]
    assert done.file.read_bytes() == here and done.ran == 5 and done.failed == [5] and not leftovers(out)
    assert said.getvalue().count("job 5: ") == 2 and "once more" in said.getvalue()
    again = sweep.run_plan(plan, out, engine=sweep.Dask(address), progress=io.StringIO())
    assert again.ran == 1 and again.file.read_bytes() == here  # the failed one alone


def test_jobs_that_the_scheduler_drops_are_asked_for_again(plan, here, dask, tmp_path):
    address, _ = dask
    import distributed

    out, dropped = tmp_path / "out", []

    def drop_what_waits():
        while not list(out.glob("rows/*.json")):
            time.sleep(0.01)
        with distributed.Client(address, set_as_default=False) as other:
            waiting = other.run_on_scheduler(lambda dask_scheduler: [key for key in dask_scheduler.tasks if key.startswith("phare-")])
            other.cancel([distributed.Future(key, client=other) for key in waiting], force=True)
            dropped.extend(waiting)

    dropper = threading.Thread(target=drop_what_waits, daemon=True)
    dropper.start()
    done = sweep.run_plan(plan, out, engine=sweep.Dask(address), progress=io.StringIO())
    dropper.join(timeout=60)
    assert not dropper.is_alive() and dropped and done.file.read_bytes() == here and not leftovers(out)


class DroppedWhileItIsFetched:
    """A client whose every job is done, and dropped, the first time it is asked for, while its answer is on the way."""

    status = "running"

    def __init__(self):
        self.asked = []

    def submit(self, _, job, *rest, **named):
        self.asked.append(job.number)
        return DroppedWhileItIsFetched.Done(first=self.asked.count(job.number) == 1)

    class Done:
        status = "finished"

        def __init__(self, first):
            self.first = first

        def result(self, timeout=None):
            if self.first:
                raise concurrent.futures.CancelledError("dropped")
            return True

        def release(self):
            pass


def test_a_job_that_is_dropped_while_its_answer_is_fetched_is_asked_for_again(plan, tmp_path):
    pytest.importorskip("distributed")
    client = DroppedWhileItIsFetched()
    work = Work(plan, plan.jobs, tmp_path, tell=lambda line: None)
    ended = list(sweep.Dask("tcp://nowhere:1")._gather(client, work))
    assert sorted(job.number for job, _ in ended) == [job.number for job in plan.jobs]
    assert all(why == "" for _, why in ended)
    assert sorted(client.asked) == sorted(2 * [job.number for job in plan.jobs])


class ForgottenWithoutAWord:
    """A client whose every job is forgotten by its scheduler the first time it is asked for, and is done the second time."""

    status = "running"

    def __init__(self):
        self.jobs = {}
        self.scheduler = types.SimpleNamespace(get_task_status=self.state)

    def submit(self, _, job, *rest, key, **named):
        first = all(of.number != job.number for of in self.jobs.values())
        self.jobs[key] = future = ForgottenWithoutAWord.Future(key, job.number, "pending" if first else "finished")
        return future

    def state(self, keys):
        return {key: None if self.jobs[key].status == "pending" else "memory" for key in keys}

    def sync(self, ask, callback_timeout, **named):
        return ask(**named)

    class Future:
        def __init__(self, key, number, status):
            self.key, self.number, self.status = key, number, status

        def result(self, timeout=None):
            return True

        def release(self):
            pass


def test_jobs_that_the_scheduler_forgets_without_a_word_are_asked_for_again(plan, tmp_path, monkeypatch):
    pytest.importorskip("distributed")
    monkeypatch.setattr(dask_engine, "_TELL_AFTER_S", 0.3)
    client = ForgottenWithoutAWord()
    client.scheduler_info = lambda: {"workers": {"one": {}}}
    ended = list(sweep.Dask("tcp://nowhere:1")._gather(client, Work(plan, plan.jobs, tmp_path, tell=lambda line: None)))
    assert sorted(job.number for job, _ in ended) == [job.number for job in plan.jobs] and all(why == "" for _, why in ended)
    assert sorted(of.number for of in client.jobs.values()) == sorted(2 * [job.number for job in plan.jobs])


def test_a_scheduler_that_is_lost_is_told_and_the_sweep_goes_on_without(plan, here, dask, tmp_path):
    address, running = dask
    out = tmp_path / "out"

    def end_it():
        while not list(out.glob("rows/*.json")):
            time.sleep(0.01)
        running[0].kill()

    killer = threading.Thread(target=end_it)
    killer.start()
    with pytest.raises(phare.Failed, match="scheduler is gone; the same command goes on"):
        sweep.run_plan(plan, out, engine=sweep.Dask(address), progress=io.StringIO())
    killer.join()
    for worker in running[1:]:
        worker.kill()
        worker.wait()
    done = sweep.run_plan(plan, out, progress=io.StringIO())
    assert 1 <= done.ran <= 4 and done.file.read_bytes() == here and not leftovers(out)


@pytest.mark.parametrize("lost", [OSError("in <TCP (closed)>: Stream is closed"), asyncio.CancelledError(), concurrent.futures.CancelledError()])
def test_a_scheduler_that_is_lost_in_the_middle_of_an_answer_is_told_too(lost, plan, tmp_path):
    pytest.importorskip("distributed", reason="Dask is not tried: apt-get install python3-distributed")

    class Broken:
        status = "finished"

        def result(self, timeout=None):
            raise lost

    class Gone:
        status = "closed"  # what a client is that has found no way back

        def submit(self, *what, **named):
            return Broken()

    with pytest.raises(phare.Failed, match="tcp://gone: the scheduler is gone; the same command goes on"):
        list(sweep.Dask("tcp://gone")._gather(Gone(), Work(plan, plan.jobs, tmp_path, tell=lambda line: None)))


def test_a_cluster_of_its_own(plan, here, tmp_path):
    pytest.importorskip("distributed", reason="Dask is not tried: apt-get install python3-distributed")
    said = cli(plan, tmp_path / "out", "--dask", "local", "--workers", "2")
    assert said.returncode == 1 and "without figures: job 5" in said.stderr and said.stderr.count("job 5: ") == 2
    assert "Traceback" not in said.stderr
    assert (tmp_path / "out" / Path(said.stdout.splitlines()[1]).name.split(" ")[0]).read_bytes() == here


def test_no_scheduler_is_bad_input(plan, tmp_path):
    pytest.importorskip("distributed", reason="Dask is not tried: apt-get install python3-distributed")
    for address in ("tcp://127.0.0.1:1", "nonsense://x"):
        said = cli(plan, tmp_path / "out", "--dask", address)
        assert said.returncode == 2 and f"--dask {address}: no scheduler answers there" in said.stderr
    assert cli(plan, tmp_path / "out", "--dask", "local", "--slurm").returncode == 2


def test_what_is_missing_is_said(plan, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(phare.BadInput, match="apt-get install python3-distributed"):
        sweep.Dask("local")
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(phare.BadInput, match="no program sbatch: apt-get install slurm-client"):
        sweep.Slurm()


# ---- Slurm


@pytest.fixture(scope="module")
def slurm(tmp_path_factory):
    why = slurm_here.missing()
    if why:
        pytest.skip(why)
    with slurm_here.Cluster(tmp_path_factory.mktemp("slurm")) as cluster:
        yield cluster


def test_slurm_gives_the_same_table_though_a_task_is_killed(plan, here, slurm, tmp_path):
    out, said = tmp_path / "out", io.StringIO()
    killer = kill_a_job(out, not_before=1)
    done = sweep.run_plan(plan, out, engine=sweep.Slurm(), progress=said)
    killer.join()
    assert killer.killed and "of Slurm ended without figures" in said.getvalue()
    assert done.file.read_bytes() == here and done.failed == [5] and not leftovers(out)
    assert said.getvalue().count("job 5: ") == 2
    until = time.monotonic() + 30  # a task whose row is there may be about to end
    while (queue := slurm.say("squeue", "--noheader")) and time.monotonic() < until:
        time.sleep(0.1)
    assert queue == ""
    assert len(list((out / "slurm").glob("array-*.sh"))) == 4  # two tasks an array here: 2 + 2 + 1, and the killed one


def test_a_node_that_is_lost_has_its_tasks_driven_again(plan, here, slurm, tmp_path):
    out = tmp_path / "out"

    def lose_it():
        while not list(out.glob("jobs/*.making-*")):
            time.sleep(0.01)
        host = slurm.say("sinfo", "--noheader", "--format=%n").strip()
        slurm.say("scontrol", "update", f"NodeName={host}", "State=DOWN", "Reason=test")
        states.append(slurm.say("squeue", "--noheader", "--array", "--format=%T"))
        slurm.say("scontrol", "update", f"NodeName={host}", "State=RESUME")
        for array in set(slurm.say("squeue", "--noheader", "--format=%A").split()):  # else Slurm waits two minutes with them
            slurm.say("scontrol", "update", f"JobId={array}", "StartTime=now")

    states: list[str] = []
    loser = threading.Thread(target=lose_it)
    loser.start()
    done = sweep.run_plan(plan, out, engine=sweep.Slurm(at_a_time=1), progress=io.StringIO())
    loser.join()
    assert "PENDING" in states[0] and "RUNNING" not in states[0]
    assert done.file.read_bytes() == here and not leftovers(out)


def test_what_slurm_refuses_is_told(plan, slurm, tmp_path, monkeypatch):
    monkeypatch.setenv("SBATCH_PARTITION", "nowhere")
    said = cli(plan, tmp_path / "out", "--slurm")
    assert said.returncode == 1 and "--slurm: sbatch: " in said.stderr and "invalid partition" in said.stderr


def test_a_head_that_is_ended_leaves_no_array_behind(plan, here, slurm, tmp_path):
    out, environment = tmp_path / "out", {**os.environ, "PYTHONPATH": PACKAGE}
    command = [sys.executable, "-m", "phare.sweep", str(plan.file), "--out", str(out), "--slurm", "--workers", "1"]

    def ours(before):
        """An array of this head's own runs."""
        scripts = set(out.glob("slurm/array-*.sh"))
        return scripts - before and "RUNNING" in slurm.say("squeue", "--noheader", "--format=%T")

    for how in (signal.SIGKILL, signal.SIGINT):
        before = set(out.glob("slurm/array-*.sh"))
        head = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        until = time.monotonic() + 60
        while not ours(before) and head.poll() is None and time.monotonic() < until:
            time.sleep(0.05)
        head.send_signal(how)
        assert head.wait(60) == (130 if how == signal.SIGINT else -9)
        arrays = set(slurm.say("squeue", "--noheader", "--format=%A", "--states=PENDING,RUNNING").split())
        assert bool(arrays) == (how == signal.SIGKILL)
    done = sweep.run_plan(plan, out, engine=sweep.Slurm(), progress=io.StringIO())
    assert 1 <= done.ran <= 5 and done.file.read_bytes() == here and not leftovers(out)
