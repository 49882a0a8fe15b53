"""The paper's figures and claims from the program's own runs: `make paper`."""
