"""The only place that opens ports and buses."""
