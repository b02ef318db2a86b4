"""The service: journal, pipeline, workers, devices."""
