"""A Ray cluster of two nodes on this machine, for tests; skipped where Ray is not installed.

All tests with it are of one xdist group, so that one worker starts one cluster (pytest --dist loadgroup).
"""

import contextlib
import logging
import os
import socket
import warnings

import pytest

OBJECT_STORE_BYTES = 80_000_000  # 75 MB is the least that Ray takes
ENVIRONMENT = {
    "RAY_USAGE_STATS_ENABLED": "0",
    "RAY_ACCEL_ENV_VAR_OVERRIDE_ON_ZERO": "0",  # without it Ray warns of a change to come
    "RAY_worker_niceness": "0",  # at Ray's own 15 whatever else the machine does starves workers for minutes
    "RAY_agent_register_timeout_ms": "150000",  # 30 s are too few where many tests share two cores
}
ATTEMPTS = 3
AGENT_PORTS = ("metrics_agent_port", "metrics_export_port", "dashboard_agent_listen_port", "runtime_env_agent_port")
"""If Ray is to find these itself it gives a node up after 15 s, too few here (ray-project/ray, issue 65983)."""


def node():
    """Arguments of a small node."""
    with contextlib.ExitStack() as open_sockets:
        sockets = [open_sockets.enter_context(socket.socket()) for _ in AGENT_PORTS]
        for one in sockets:
            one.bind(("127.0.0.1", 0))
        ports = {name: one.getsockname()[1] for name, one in zip(AGENT_PORTS, sockets, strict=True)}
    return {"num_cpus": 1, "object_store_memory": OBJECT_STORE_BYTES, **ports}


class TwoNodes:
    """A Ray cluster of two nodes with a CPU each, on this machine; the second can be killed, and put back."""

    def __init__(self, cluster):
        self._cluster = cluster
        self._second = None

    def complete(self):
        """Two nodes, whatever has happened to the second."""
        for left in reversed(range(ATTEMPTS)):
            if self._second is not None:
                return
            try:
                self._second = self._cluster.add_node(**node())
            except Exception:  # a bare one: Ray gives a node 30 s to start, and what else runs here may take them all
                if not left:
                    raise

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
    os.environ |= ENVIRONMENT
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of Ray's own start
        import ray
        from ray.cluster_utils import Cluster

        head = {**node(), "include_dashboard": False, "include_log_monitor": False}
        cluster = Cluster(initialize_head=True, head_node_args=head)
        ray.init(address=cluster.address, log_to_driver=False, logging_level=logging.ERROR)
    nodes = TwoNodes(cluster)
    nodes.complete()
    yield nodes
    ray.shutdown()
    cluster.shutdown()


@pytest.fixture
def cluster(two_nodes):
    """The cluster; its second node may have been killed by another test, see `TwoNodes.complete`."""
    return two_nodes
