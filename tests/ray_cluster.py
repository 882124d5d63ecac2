"""A Ray cluster of two nodes on this machine, for tests; skipped where Ray is not installed.

All tests with it are of one xdist group, so that one worker starts one cluster (pytest --dist loadgroup). Its session,
its folder and its ports are its own: any number of test runs may have a cluster at once on one machine.
"""

import contextlib
import logging
import random
import re
import shutil
import socket
import tempfile
import time
import warnings

import pytest

OBJECT_STORE_BYTES = 80_000_000  # 75 MB is the least that Ray takes
PATIENCE_S = 300  # for a process to start: seconds, or minutes where many tests share a core
ENVIRONMENT = {
    "RAY_USAGE_STATS_ENABLED": "0",
    "RAY_ACCEL_ENV_VAR_OVERRIDE_ON_ZERO": "0",  # without it Ray warns of a change to come
    "RAY_worker_niceness": "0",  # at Ray's own 15 whatever else the machine does starves workers for minutes
    "RAY_memory_monitor_refresh_ms": "0",  # else Ray kills workers for what others use of the machine's memory
    "RAY_agent_register_timeout_ms": str(PATIENCE_S * 1000),  # Ray's own limits are 20 to 60 s
    "RAY_worker_register_timeout_seconds": str(PATIENCE_S),
    "RAY_gcs_server_request_timeout_seconds": str(PATIENCE_S),
    "RAY_gcs_server_port_wait_time_s": str(PATIENCE_S),
    "RAY_health_check_timeout_ms": str(PATIENCE_S * 1000),  # of a slow node; one that is gone does not answer
}
PORTS = range(20_000, 32_000)  # below those that the system gives to whoever asks for any, perhaps before Ray listens
AGENT_PORTS = ("metrics_agent_port", "metrics_export_port", "dashboard_agent_listen_port", "runtime_env_agent_port")
"""Told to Ray: see `Patience`."""


def free_ports(n):
    """Return n ports on which nothing listens, at random: another cluster that starts now looks elsewhere."""
    found = []
    for port in random.SystemRandom().sample(PORTS, len(PORTS)):
        with socket.socket() as one, contextlib.suppress(OSError):
            one.bind(("", port))
            found.append(port)
        if len(found) == n:
            break
    return found


def node():
    ports = dict(zip(AGENT_PORTS, free_ports(len(AGENT_PORTS)), strict=True))
    return {"num_cpus": 1, "object_store_memory": OBJECT_STORE_BYTES, **ports}


class Patience:
    """Time for nodes to start, which Ray limits twice, without settings.

    Its raylet ends itself when its agent takes over 15 s, unless it is told the port (issue 65983), which `ray.init`
    does not do. Who starts a node waits for 30 s ("The current node timed out during startup"), slow or dead.
    """

    def __init__(self, services):
        self._start, self._get_node = services.start_ray_process, services.get_node
        self._raylet = None

    def start_ray_process(self, command, process_type, *given, **options):
        """Start a process of Ray; the raylet is told where its agent is going to listen."""
        if process_type != "raylet":
            return self._start(command, process_type, *given, **options)
        port = re.search(r"--listen-port=(\d+)", " ".join(command))[1]
        command = [*command, f"--dashboard_agent_listen_port={port}"]
        self._raylet = self._start(command, process_type, *given, **options)
        return self._raylet

    def get_node(self, gcs_address, node_id):
        """Return what Ray knows of a node, as soon as it has registered itself."""
        deadline = time.monotonic() + PATIENCE_S
        while True:
            try:
                return self._get_node(gcs_address, node_id)
            except RuntimeError as error:
                if self._raylet is not None and self._raylet.process.poll() is not None:
                    raise ConnectionError("a Ray node ended while it started; its log is raylet.err") from error
                if time.monotonic() > deadline:
                    raise TimeoutError(f"waited {PATIENCE_S} s for a Ray node to start: {error}") from error
            time.sleep(0.2)


class TwoNodes:
    """A Ray cluster of two nodes with a CPU each, on this machine; the second can be killed, and put back."""

    def __init__(self, cluster):
        self._cluster = cluster
        self._second = None

    def complete(self):
        if self._second is None:
            self._second = self._cluster.add_node(**node())

    @staticmethod
    def send_by_value(module):
        """Send the classes of a test's module to workers, which cannot import it."""
        from ray import cloudpickle

        cloudpickle.register_pickle_by_value(module)

    def kill(self):
        """End the second node's processes, without a warning to anybody."""
        assert self._second is not None
        self._cluster.remove_node(self._second, allow_graceful=False)
        self._second = None


@pytest.fixture(scope="session")
def two_nodes():
    pytest.importorskip("ray", reason="Ray is not installed (pip install 'bayesmap[ray]')")
    folder = tempfile.mkdtemp(prefix="ray-", dir="/tmp")  # short: a socket's path has 107 letters at most
    with pytest.MonkeyPatch.context() as patch:
        for name, value in {**ENVIRONMENT, "RAY_TMPDIR": folder}.items():
            patch.setenv(name, value)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of Ray's own start
            import ray
            from ray._private import services
            from ray.cluster_utils import Cluster

            patience = Patience(services)
            patch.setattr(services, "start_ray_process", patience.start_ray_process)
            patch.setattr(services, "get_node", patience.get_node)
            head = {**node(), "include_dashboard": False, "include_log_monitor": False, "no_monitor": True}
            cluster = Cluster(initialize_head=True, head_node_args=head)
            ray.init(address=cluster.address, log_to_driver=False, logging_level=logging.ERROR)
        nodes = TwoNodes(cluster)
        nodes.complete()
        yield nodes
        ray.shutdown()
        cluster.shutdown()
    shutil.rmtree(folder, ignore_errors=True)


@pytest.fixture
def cluster(two_nodes):
    """The cluster; its second node may have been killed by another test, see `TwoNodes.complete`."""
    return two_nodes
