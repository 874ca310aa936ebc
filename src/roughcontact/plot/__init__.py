"""Pictures: functions of axes and data."""
